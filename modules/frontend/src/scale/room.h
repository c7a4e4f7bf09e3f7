#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

#include <cmath>
#include <vector>

namespace oneac {

/// How far what is seen lies from the line of travel, but for the nearest tenth of it, in the unit
/// of T_2_1.t; infinite where nothing has a depth.
/// @param acs      normalised
/// @param inliers  one per correspondence
[[nodiscard]] double room_beside(AcSpan acs, const std::vector<bool>& inliers,
                                 const RelativePose& T_2_1);

/// Whether a step goes where wheels take a car that went along `heading`, forwards or backwards: a
/// wrong basin of two views may lie anywhere, and no length along it is one of the car.
/// @param t, heading  of T_2_1, of any length
[[nodiscard]] inline bool goes_along(const Eigen::Vector3d& t, const Eigen::Vector3d& heading) {
  constexpr double kCos45 = 0.7071;  // a front corner of a car that turns on the spot
  return std::abs(t.dot(heading)) >= kCos45 * t.norm() * heading.norm();
}

/// Whether a car fits through what is seen at a scale. A bonnet rests in the picture as a road at
/// rest does; who takes it for the road has a scene that fits into a shoe box. The road itself is
/// one height away from the line of travel, and half a car is wider than half of that; what is
/// nearer lies on the way, like the truck ahead.
/// @param room_heights  room_beside() in camera heights
[[nodiscard]] constexpr bool is_wide_enough(double room_heights) {
  return !(room_heights < 0.5);
}

}  // namespace oneac
