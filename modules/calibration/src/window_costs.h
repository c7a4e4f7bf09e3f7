#pragma once

#include "oneac/calibration/intrinsics.h"
#include "oneac/geometry/relative_pose.h"

#include <ceres/cost_function.h>

#include <Eigen/Core>

namespace oneac {

/// A landmark's ray and inverse depth (x, y, ρ) stand in the frame of an anchor view as it was at
/// the start, which does not move; a view's pose is (w, v): R = exp([w]×) R₀, t = t₀ + v.

/// Reprojection into a raw image, in standard deviations. Blocks: IntrinsicsVector, pose,
/// landmark. Caller owns.
/// @param T_view_anchor  at the start
/// @param t_view         t₀ of the view against the map
[[nodiscard]] ceres::CostFunction* reprojection_cost(const PinholeCamera& from,
                                                     const RelativePose& T_view_map,
                                                     const RelativePose& T_anchor_map,
                                                     const Eigen::Vector2d& u, double sigma_px);

/// The way from the first view (fixed) to another one keeps its length. Block: pose of that.
[[nodiscard]] ceres::CostFunction* length_cost(const RelativePose& first,
                                               const RelativePose& T_view_map);

/// Gaussian prior of the change, mean 0. Block: IntrinsicsVector.
[[nodiscard]] ceres::CostFunction* prior_cost(const IntrinsicsMatrix& information);

}  // namespace oneac
