#include "oneac/study/readings.h"

#include <algorithm>
#include <iterator>

namespace oneac {
namespace {

/// Figures that judge_claims looks at; one of each experiment is enough to run it.
constexpr std::string_view kClaimFigures[] = {"a", "c", "e", "g", "i1", "i3", "s1", "s3"};

[[nodiscard]] std::vector<std::string> claim_figures(const StudyOptions& options) {
  std::vector<std::string> chosen;
  for (const Figure& wanted : wanted_figures(options)) {
    for (const Figure& figure : figures()) {
      if (figure.experiment != wanted.experiment) continue;
      const bool judged = std::find(std::begin(kClaimFigures), std::end(kClaimFigures),
                                    figure.id) != std::end(kClaimFigures);
      if (judged) chosen.emplace_back(figure.id);
    }
  }
  return chosen;
}

}  // namespace

const std::vector<Reading>& readings() {
  static const std::vector<Reading> kReadings = {
      {"all four correspondences for every method; affine errors up to the level",
       NoiseShape::kUniform, DataUse::kAll},
      {"all four; of exactly the level", NoiseShape::kFixed, DataUse::kAll},
      {"all four; normal", NoiseShape::kNormal, DataUse::kAll},
      {"all four; up to the level, one angle for U and V", NoiseShape::kCommon, DataUse::kAll},
      {"one for 1AC, two for 2AC, four for 4PC; up to the level", NoiseShape::kUniform,
       DataUse::kMinimal},
      {"one, two, four; of exactly the level", NoiseShape::kFixed, DataUse::kMinimal},
      {"one, two, four; normal", NoiseShape::kNormal, DataUse::kMinimal},
      {"one, two, four; up to the level, one angle for U and V", NoiseShape::kCommon,
       DataUse::kMinimal},
  };
  return kReadings;
}

std::vector<StudyResult> run_readings(const StudyOptions& options, const StudyProgress& progress) {
  std::vector<StudyResult> results;
  StudyOptions changed = options;
  changed.figures = claim_figures(options);
  if (changed.figures.empty()) return results;
  bool stopped = false;
  std::size_t trials_before = 0, trials_now = 0;
  for (const Reading& reading : readings()) {
    changed.noise_shape = reading.noise_shape;
    changed.data_use = reading.data_use;
    const double before = static_cast<double>(results.size());
    const double all = static_cast<double>(readings().size());
    StudyResult result = run_study(changed, [&](double share, std::size_t trials) {
      trials_now = trials_before + trials;
      stopped = progress && !progress((before + share) / all, trials_now);
      return !stopped;
    });
    if (stopped) break;
    trials_before = trials_now;
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace oneac
