#pragma once

#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

namespace oneac::internal {

/// Cayley's rotation for the rotation vector w: exact to second order, orthonormal for any w, no
/// trigonometry.
[[nodiscard]] inline Eigen::Matrix3d small_rotation(const Eigen::Vector3d& w) {
  const Eigen::Matrix3d H = cross_matrix(0.5 * w);
  const double scale = 2.0 / (1.0 + 0.25 * w.squaredNorm());
  return Eigen::Matrix3d::Identity() + scale * (H + H * H);
}

}  // namespace oneac::internal
