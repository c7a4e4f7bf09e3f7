#pragma once

#include "log_pairs.h"

#include "oneac/evaluation/pair_errors.h"
#include "oneac/robust/robust_result.h"
#include "oneac/solvers/span.h"

#include <functional>
#include <vector>

namespace oneac {

/// What makes the pairs of a drive harder. Seeded: the same for every estimator.
struct Stress {
  double outliers = 0.0;   ///< share that wrong correspondences are made to have
  double pitch_deg = 0.0;  ///< largest turn of the second view, taken out of the answer again
  double roll_deg = 0.0;
};

/// How an estimator did over a drive.
struct StressRow {
  PairSummary summary;
  double median_ms = 0.0;        ///< CPU time of a pair
  double correspondences = 0.0;  ///< median
};

using PairEstimator = std::function<RobustResult(AcSpan, const LogPair&)>;

/// Estimates every pair with a true motion under stress.
[[nodiscard]] StressRow measure_under(const Stress& stress, const std::vector<LogPair>& pairs,
                                      const Trajectory& truth, const PairEstimator& estimate);

}  // namespace oneac
