#pragma once

#include "oneac/comparison/pair_record.h"
#include "oneac/evaluation/statistics.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// How far one estimate is from the truth; empty where it cannot be judged.
struct ResultError {
  std::optional<double> rotation;   ///< [rad]
  std::optional<double> direction;  ///< [rad]
  bool failed = false;              ///< no pose, or in a wrong basin as PairError::is_bad() says
  /// What AUC judges: the larger of both, of the rotation alone where the true direction is not
  /// known; infinite without a pose, or without a direction where there is a true one; empty
  /// without a reference.
  std::optional<double> pose;
};
/// Of one method on one pair, against the reference where there is one.
[[nodiscard]] ResultError error_of(const PairRecord& pair, const MethodResult& result);

/// Area under the recall curve up to a bound, as a share of the bound.
/// @param errors  [rad] infinite for failures  @param bound [rad]
[[nodiscard]] std::optional<double> area_under_recall(const std::vector<double>& errors,
                                                      double bound);

inline constexpr std::array<double, 3> kAucBounds_deg = {1.0, 5.0, 10.0};

/// One method on one log, or averaged over logs.
struct MethodSummary {
  std::string log;  ///< "average" over logs: means of the logs' values, sums of counts
  std::string method;
  std::size_t estimates = 0;
  std::size_t judged = 0;  ///< with a reference
  std::size_t no_pose = 0;
  std::size_t failures = 0;
  std::optional<double> rotation_mean_deg, rotation_median_deg, rotation_p95_deg;
  std::optional<double> direction_mean_deg, direction_median_deg, direction_p95_deg;
  std::array<std::optional<double>, 3> auc;  ///< at kAucBounds_deg [-]
  std::optional<double> iterations_mean, inlier_share_mean;
  std::optional<double> ms_mean, ms_median, ms_p95;
};

/// By log, then method; logs without pairs are left out. Ends with the average when there are two
/// logs or more.
[[nodiscard]] std::vector<MethodSummary> summarise(const ComparisonData& data);

}  // namespace oneac
