#include "oneac/base/number_text.h"
#include "oneac/report/table.h"
#include "oneac/study/claims.h"
#include "oneac/study/readings.h"
#include "oneac/study/report.h"

#include <algorithm>

namespace oneac {
namespace {

// Points of a sweep that the tables show: every so many.
constexpr std::size_t kEveryNoise = 2, kEveryAngle = 2;
// A share of trials without a result above which the summary says so.
constexpr double kManyFailures = 0.001;

[[nodiscard]] std::string_view meaning_of(const StudyOptions& options) {
  for (const Reading& reading : readings()) {
    if (reading.noise_shape == options.noise_shape && reading.data_use == options.data_use) {
      return reading.meaning;
    }
  }
  return "";
}

[[nodiscard]] std::string setup(const StudyOptions& options) {
  return "Planes at distance 1, baseline 0.1, focal length 1000 px, image 1000×1000 px, no "
         "rotation "
         "but the tilt; four plane points a trial, uniform over the first image, seen by both "
         "cameras and at most 10 deep.\n"
         "Of the candidates that cheirality leaves (one or two), every method is given the one "
         "closest to the truth, the rivals too.\n"
         "Errors are those of the camera's full motion, tilt included; means over the trials with "
         "a result.\n\n" +
         std::to_string(options.trials) + " trials a point, seed " + std::to_string(options.seed) +
         ". Reading of the paper: " + std::string(meaning_of(options)) + ".\n";
}

[[nodiscard]] std::string claims_text(const StudyResult& result) {
  std::string text;
  for (const Claim& claim : judge_claims(result)) {
    text += "\n### " + claim.paper + "\n";
    text += claim.holds() ? "**Confirmed.**"
                          : "**Our result disagrees with the paper** in " +
                                std::to_string(claim.comparisons - claim.upheld) + " of " +
                                std::to_string(claim.comparisons) + " comparisons.";
    text +=
        (claim.where.empty() ? "" : " By the means: " + claim.where + ".") + "\n\n" + claim.finding;
  }
  return text;
}

[[nodiscard]] std::string verdict(const Claim& claim) {
  const std::string where = claim.where.empty() ? "" : "; " + claim.where;
  if (claim.holds()) return "yes" + where;
  return "no: " + std::to_string(claim.upheld) + " of " + std::to_string(claim.comparisons) + where;
}

/// A row per reading, a column per claim.
[[nodiscard]] std::string readings_text(const std::vector<StudyResult>& results) {
  if (results.empty()) return "";
  std::string text =
      "\n## Under every reading of the paper\n"
      "The paper says neither how errors are distributed within a level, nor whether the two "
      "rotations of an affinity's SVD have errors of their own, nor whether its solvers saw one "
      "correspondence or all four of a trial.\n"
      "The figures show the reading in which every method sees the same data (chosen with this "
      "table "
      "known, so it is no evidence of what the paper did); here is what the "
      "others give. Each cell says whether the claim holds, else how many of its comparisons "
      "(error × rival × experiment) do.\n\n"
      "Likely reason for the differences: the whole motion is a tenth of the distance to the "
      "plane, so it changes the entries of an affinity by about 0.1; errors of 5° and 5 % change "
      "them by as much. One correspondence then says little about the direction of travel, while "
      "four points, whose errors are a thousandth, say more. Four correspondences average the "
      "affine errors, and a common angle for U and V nearly cancels in U S Vᵀ. Under tilt, a "
      "planar solver's rotation "
      "error cannot be less than the tilt itself: it loses at the tilt that equals the rival's "
      "error, which is much less for a 2AC that uses four correspondences than for one that uses "
      "two.\n\n";
  Table table{"", {"reading"}, {}};
  for (const Claim& claim : judge_claims(results.front())) table.head.push_back(claim.id);
  table.text_columns = table.head.size();
  for (const StudyResult& result : results) {
    table.rows.push_back({{std::string(meaning_of(result.options))}});
    for (const Claim& claim : judge_claims(result)) table.rows.back().push_back({verdict(claim)});
  }
  return text + table_md(table);
}

/// "mean (median)" of the methods at some points of a sweep.
[[nodiscard]] std::string means_of(const ExperimentResult& result, StudyMetric metric) {
  const Experiment& experiment = *result.experiment;
  Table table{"", {std::string(metric_name(metric)) + " error [°] at"}, {}};
  const std::size_t every = experiment.sweep == StudySweep::kWallAngle ? kEveryAngle : kEveryNoise;
  const int decimals = experiment.sweep == StudySweep::kWallAngle ? 0 : 1;
  for (std::size_t i = 0; i < result.points.size(); i += every) {
    table.head.push_back(fixed_text(result.points[i].value, decimals) + " " +
                         std::string(sweep_unit(experiment.sweep)));
  }
  for (std::size_t m = 0; m < experiment.methods.size(); ++m) {
    table.rows.push_back({{std::string(experiment.methods[m]->label)}});
    for (std::size_t i = 0; i < result.points.size(); i += every) {
      const ErrorStatistics& errors = result.points[i].methods[m].of(metric);
      table.rows.back().push_back(
          {fixed_text(errors.mean, 2) + " (" + fixed_text(errors.median, 2) + ")"});
    }
  }
  return table_md(table) + "\n";
}

[[nodiscard]] std::string failures(const ExperimentResult& result, std::size_t trials) {
  std::string text;
  for (std::size_t m = 0; m < result.experiment->methods.size(); ++m) {
    std::size_t solved = trials;
    for (const PointResult& point : result.points) {
      solved = std::min(solved, point.methods[m].solved);
    }
    const double share = 1.0 - static_cast<double>(solved) / static_cast<double>(trials);
    if (share < kManyFailures) continue;
    text += (text.empty() ? "Without a result, at the worst point: " : ", ") +
            std::string(result.experiment->methods[m]->label) + " " + fixed_text(100.0 * share, 1) +
            " %";
  }
  return text.empty() ? "" : text + ".\n\n";
}

[[nodiscard]] std::string experiment_text(const StudyResult& result,
                                          const ExperimentResult& experiment) {
  std::string text = "\n### " + std::string(experiment.experiment->title) + "\n";
  std::string tables;
  for (const Figure& figure : wanted_figures(result.options)) {
    if (figure.experiment != experiment.experiment->name) continue;
    text += "[(" + std::string(figure.id) + ")](" + figure.name() + ".svg) ";
    tables += means_of(experiment, figure.metric);
  }
  return text + "mean (median)\n\n" + tables + failures(experiment, result.options.trials);
}

}  // namespace

std::string summary_of(const StudyResult& result, const std::vector<StudyResult>& readings) {
  std::string text = "# Synthetic study\n\n" + setup(result.options);
  text += "\n## What the paper claims, and what came out\n" + claims_text(result);
  text += readings_text(readings);
  text += "\n## Numbers\n";
  for (const ExperimentResult& experiment : result.experiments) {
    text += experiment_text(result, experiment);
  }
  return text;
}

}  // namespace oneac
