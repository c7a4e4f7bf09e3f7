#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace oneac::internal {

/// The vector m = n/d of the plane n·X = d (unit: |t|) when one plane explains the inliers of a
/// pose as well as the pose does; empty otherwise. Then a second pose explains them as well.
/// @param threshold  [-] of an inlier
[[nodiscard]] std::optional<Eigen::Vector3d> common_plane(const RelativePose& T_2_1, AcSpan acs,
                                                          const std::vector<bool>& inliers,
                                                          double threshold);

/// The other motion (and its plane) with the same homography R + t mᵀ, |t| = 1; empty when there is
/// none. Source: the two physically possible solutions of the homography decomposition.
[[nodiscard]] std::optional<RelativePose> twin_pose(const RelativePose& T_2_1,
                                                    const Eigen::Vector3d& m, AcSpan acs,
                                                    const std::vector<bool>& inliers);

}  // namespace oneac::internal
