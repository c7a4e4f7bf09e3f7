#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/solvers/span.h"

#include <vector>

namespace oneac {

/// [m] to either side of the camera that are looked at for road: a lane and as much again. Beyond
/// them stand parked cars, kerbs and footways, whose feet pass for a road of another height.
constexpr double kStrip_m = 3.3;

/// How far what is seen lies from the line of travel, but for the nearest tenth of it, in the unit
/// of T_2_1.t; infinite where nothing has a depth.
/// @param acs      normalised
/// @param inliers  one per correspondence
[[nodiscard]] double room_beside(AcSpan acs, const std::vector<bool>& inliers,
                                 const RelativePose& T_2_1);

/// Whether a car fits through what is seen at a scale. A bonnet rests in the picture as a road at
/// rest does; who takes it for the road has a scene that fits into a shoe box. The road itself is
/// one height away from the line of travel, and half a car is wider than half of that; what is
/// nearer lies on the way, like the truck ahead.
/// @param room_heights  room_beside() in camera heights
[[nodiscard]] constexpr bool is_wide_enough(double room_heights) {
  return !(room_heights < 0.5);
}

}  // namespace oneac
