#include "oneac/study/claims.h"

#include "oneac/base/number_text.h"

#include <algorithm>
#include <array>

namespace oneac {
namespace {

constexpr std::array<StudyMetric, 2> kPose = {StudyMetric::kRotation, StudyMetric::kTranslation};
// "Below approx. 1.0 degree": the sweep's points up to this tilt must be won.
constexpr double kAboutOneDegree = 0.9;

/// Where a − b changes from below zero to zero or more, between the points; empty without a change.
struct CrossingFinder {
  std::optional<double> previous_value;
  double previous_gap = 0.0;
  std::optional<double> crossing;

  void add(double value, double gap) {
    if (!crossing && gap >= 0.0) {
      const bool falls = previous_value && previous_gap < 0.0;
      crossing =
          falls ? *previous_value + (value - *previous_value) * previous_gap / (previous_gap - gap)
                : value;
    }
    previous_value = value;
    previous_gap = gap;
  }
};

[[nodiscard]] std::string where(const std::optional<double>& lost_from, StudySweep sweep) {
  if (!lost_from) return "stays lower to the end";
  return "lower up to " + fixed_text(*lost_from, 2) + " " + std::string(sweep_unit(sweep));
}

[[nodiscard]] std::string item(const ExperimentResult& result, StudyMethod theirs,
                               StudyMetric metric, const Comparison& comparison) {
  const StudyMethod ours = result.experiment->methods.front();
  std::string text = std::string(result.experiment->title) + ", " +
                     std::string(metric_name(metric)) + ": " + std::string(ours->label) +
                     " against " + std::string(theirs->label) + ": lower mean at " +
                     std::to_string(comparison.won) + " of " + std::to_string(comparison.points) +
                     " points (median: " + std::to_string(comparison.won_by_median) +
                     "), mean ratio " + significant_text(comparison.best_ratio, 2) + " … " +
                     significant_text(comparison.worst_ratio, 2);
  const StudySweep sweep = result.experiment->sweep;
  if (sweep != StudySweep::kWallAngle && !comparison.won_all()) {
    text += "; mean " + where(comparison.lost_from, sweep) + ", median " +
            where(comparison.lost_from_median, sweep);
  }
  return text + "\n";
}

/// Compares ours with both rivals in both errors; `judge` decides on each comparison.
template <class Judge>
void add_findings(const ExperimentResult* result, Claim& claim, Judge&& judge) {
  if (result == nullptr) return;
  const StudyMethod ours = result->experiment->methods.front();
  const bool skip_first = result->experiment->sweep == StudySweep::kNoise;
  for (const StudyMetric metric : kPose) {
    for (const StudyMethod theirs :
         {study_method("homography_4pc"), study_method("homography_2ac")}) {
      const Comparison comparison = compare(*result, ours, theirs, metric, skip_first);
      const bool good = judge(theirs, comparison);
      claim.finding += (good ? "- " : "- **not so:** ") + item(*result, theirs, metric, comparison);
      ++claim.comparisons;
      claim.upheld += good ? 1U : 0U;
    }
  }
}

[[nodiscard]] bool wins_everywhere(StudyMethod, const Comparison& comparison) {
  return comparison.won_all();
}

[[nodiscard]] bool wins_at_low_noise(StudyMethod, const Comparison& comparison) {
  return comparison.won_first;
}

/// Won at the lowest noise against both, lost later on against 4PC.
[[nodiscard]] bool crosses(StudyMethod theirs, const Comparison& comparison) {
  return comparison.won_first && (theirs != study_method("homography_4pc") || comparison.lost_from);
}

[[nodiscard]] bool wins_to_one_degree(StudyMethod, const Comparison& comparison) {
  return comparison.won_first &&
         (!comparison.lost_from || *comparison.lost_from >= kAboutOneDegree);
}

[[nodiscard]] Claim ground_claim(const StudyResult& result) {
  Claim claim{"ground",
              "On the ground, 1AC ground beats 4PC and 2AC in rotation and translation at every "
              "noise level above zero, forward and sideways."};
  add_findings(result.find("forward_ground"), claim, wins_everywhere);
  add_findings(result.find("sideways_ground"), claim, wins_everywhere);
  return claim;
}

/// Where 4PC takes over on the frontal wall, in rotation and in translation.
[[nodiscard]] std::string takeover(const ExperimentResult* result) {
  if (result == nullptr) return "";
  std::string text = "4PC wins";
  for (const StudyMetric metric : kPose) {
    const Comparison comparison = compare(*result, result->experiment->methods.front(),
                                          study_method("homography_4pc"), metric, true);
    text += metric == StudyMetric::kRotation ? " in rotation " : ", in translation ";
    if (!comparison.lost_from) {
      text += "nowhere up to 1 px (ratio " + fixed_text(comparison.last_ratio, 2) + " there)";
    } else {
      text += comparison.won_first ? "from " + fixed_text(*comparison.lost_from, 2) + " px"
                                   : "from the lowest noise on";
    }
  }
  return text;
}

[[nodiscard]] Claim special_wall_claim(const StudyResult& result) {
  Claim claim{"special_wall",
              "On a frontal wall, 1AC wins while the noise is not too high and 4PC at high affine "
              "noise; on a side wall 1AC wins at low noise, too."};
  add_findings(result.find("forward_front"), claim, crosses);
  add_findings(result.find("sideways_side"), claim, wins_at_low_noise);
  claim.where = takeover(result.find("forward_front"));
  return claim;
}

[[nodiscard]] Claim turned_wall_claim(const StudyResult& result) {
  Claim claim{"turned_wall",
              "On a wall of any orientation, 1AC wall beats 4PC and 2AC at all wall angles, "
              "forward and sideways."};
  add_findings(result.find("forward_wall"), claim, wins_everywhere);
  add_findings(result.find("sideways_wall"), claim, wins_everywhere);
  return claim;
}

/// "lost from 0.37°": the least tilt at which some comparison is lost.
[[nodiscard]] std::string earliest_loss(const StudyResult& result) {
  std::optional<double> least;
  for (const char* name : {"tilt_ground", "tilt_front"}) {
    const ExperimentResult* experiment = result.find(name);
    if (experiment == nullptr) continue;
    for (const StudyMetric metric : kPose) {
      for (const StudyMethod theirs :
           {study_method("homography_4pc"), study_method("homography_2ac")}) {
        const StudyMethod ours = experiment->experiment->methods.front();
        const auto lost = compare(*experiment, ours, theirs, metric, false).lost_from;
        if (lost && (!least || *lost < *least)) least = lost;
      }
    }
  }
  return least ? "first loss at " + fixed_text(*least, 2) + "°" : "no loss up to 1°";
}

[[nodiscard]] Claim tilt_claim(const StudyResult& result) {
  Claim claim{"tilt",
              "With a tilted second camera, the planar solvers win below about 1° of tilt."};
  add_findings(result.find("tilt_ground"), claim, wins_to_one_degree);
  add_findings(result.find("tilt_front"), claim, wins_to_one_degree);
  claim.where = earliest_loss(result);
  return claim;
}

}  // namespace

Comparison compare(const ExperimentResult& result, StudyMethod ours, StudyMethod theirs,
                   StudyMetric metric, bool skip_first) {
  Comparison comparison;
  CrossingFinder mean, median;
  const std::size_t a = result.index_of(ours), b = result.index_of(theirs);
  for (std::size_t i = skip_first ? 1 : 0; i < result.points.size(); ++i) {
    const PointResult& point = result.points[i];
    const ErrorStatistics& first = point.methods[a].of(metric);
    const ErrorStatistics& second = point.methods[b].of(metric);
    const double ratio = second.mean > 0.0 ? first.mean / second.mean : 1.0;
    const bool fresh = comparison.points == 0;
    if (fresh) comparison.won_first = first.mean < second.mean;
    comparison.worst_ratio = fresh ? ratio : std::max(comparison.worst_ratio, ratio);
    comparison.best_ratio = fresh ? ratio : std::min(comparison.best_ratio, ratio);
    comparison.last_ratio = ratio;
    ++comparison.points;
    comparison.won += first.mean < second.mean ? 1U : 0U;
    comparison.won_by_median += first.median < second.median ? 1U : 0U;
    mean.add(point.value, first.mean - second.mean);
    median.add(point.value, first.median - second.median);
  }
  comparison.lost_from = mean.crossing;
  comparison.lost_from_median = median.crossing;
  return comparison;
}

std::vector<Claim> judge_claims(const StudyResult& result) {
  std::vector<Claim> claims;
  for (const auto& claim_of : {ground_claim, special_wall_claim, turned_wall_claim, tilt_claim}) {
    Claim claim = claim_of(result);
    if (claim.comparisons > 0) claims.push_back(std::move(claim));
  }
  return claims;
}

}  // namespace oneac
