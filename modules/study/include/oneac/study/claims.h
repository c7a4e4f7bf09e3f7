#pragma once

#include "oneac/study/study.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oneac {

/// Two methods along a sweep, by the mean of one error (what the paper shows).
struct Comparison {
  std::size_t points = 0;  ///< of the sweep that were compared
  std::size_t won = 0;     ///< of them, points where the first method's mean is lower
  bool won_first = false;  ///< at the first of them
  std::size_t won_by_median = 0;
  double worst_ratio = 0.0;                ///< largest mean of ours over theirs
  double last_ratio = 0.0;                 ///< at the last point
  double best_ratio = 0.0;                 ///< smallest
  std::optional<double> lost_from;         ///< where ours stops being lower, interpolated
  std::optional<double> lost_from_median;  ///< the same by the median

  /// At every level of the sweep.
  [[nodiscard]] bool won_all() const { return points > 0 && won == points; }
};

/// @param skip_first  leaves out the first point, for sweeps of noise: there both errors are zero
[[nodiscard]] Comparison compare(const ExperimentResult& result, StudyMethod ours,
                                 StudyMethod theirs, StudyMetric metric, bool skip_first);

/// What the paper says, and what came out here.
struct Claim {
  std::string id;               ///< "ground", "front_wall", "turned_wall", "tilt"
  std::string paper;            ///< the paper's statement
  std::size_t comparisons = 0;  ///< error × rival × experiment
  std::size_t upheld = 0;       ///< of them, judged by the means
  std::string where{};          ///< where the winner changes, in short; may be empty
  std::string finding{};        ///< the numbers, as Markdown list items

  /// No comparison speaks against it.
  [[nodiscard]] bool holds() const { return upheld == comparisons; }
};

/// Every claim that the experiments of this run can judge.
[[nodiscard]] std::vector<Claim> judge_claims(const StudyResult& result);

}  // namespace oneac
