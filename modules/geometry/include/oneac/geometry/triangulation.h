#pragma once

#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

#include <optional>

namespace oneac {

/// A triangulated point and its depths in both views, in the length unit of t.
struct TriangulatedPoint {
  Eigen::Vector3d X1;  ///< point in the first camera frame
  double z1 = 0.0;     ///< depth in the first view
  double z2 = 0.0;     ///< depth in the second view

  [[nodiscard]] bool in_front() const { return z1 > 0.0 && z2 > 0.0; }
};

/// Midpoint of the two rays' common perpendicular. Depths may be negative (cheirality is the
/// caller's question). Empty when the rays are parallel to within `min_parallax` [rad].
[[nodiscard]] std::optional<TriangulatedPoint> triangulate(const RelativePose& T_2_1,
                                                           const Eigen::Vector2d& x1,
                                                           const Eigen::Vector2d& x2,
                                                           double min_parallax = 1e-9);

/// +1 when the point pair lies in front of both cameras, −1 when it would after flipping t, 0 when
/// neither holds or the rays are parallel.
[[nodiscard]] int cheirality(const RelativePose& T_2_1, const Eigen::Vector2d& x1,
                             const Eigen::Vector2d& x2);

}  // namespace oneac
