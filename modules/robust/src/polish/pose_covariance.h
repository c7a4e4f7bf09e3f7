#pragma once

#include "oneac/robust/polish.h"
#include "oneac/robust/robust_result.h"

namespace oneac::internal {

/// Covariance of (w, b) as in RobustResult, from the information of the polished pose and the
/// scatter of the inliers about it; zero when the points do not carry it.
/// @param squares  Σ r² over the inliers, r the Sampson distance
[[nodiscard]] Eigen::Matrix<double, 6, 6> pose_covariance(const PolishResult& polished,
                                                          const RobustResult& result,
                                                          double squares);

}  // namespace oneac::internal
