#pragma once

#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

namespace oneac {

/// Inverse depth in the first view by least squares; a point that would lie behind or beyond
/// everything is put very far away. [1/length of t]
[[nodiscard]] double inverse_depth_of(const RelativePose& T_2_1, const Eigen::Vector2d& x1,
                                      const Eigen::Vector2d& x2);

/// Inverse variance of the inverse depth that a second view contributes.
/// @param sigma  1σ of a point [-]
[[nodiscard]] double depth_information(const RelativePose& T_2_1, const Eigen::Vector2d& x1,
                                       double inverse_depth, double sigma);

}  // namespace oneac
