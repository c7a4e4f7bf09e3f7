#pragma once

#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

namespace oneac {

/// Pitch and roll of a camera against the horizon. Both zero: Y points along gravity.
struct Tilt {
  double pitch_up = 0.0;  ///< [rad] positive when the optical axis points above the horizon
  double roll_right =
      0.0;  ///< [rad] positive when the camera leans to its right (clockwise, seen from behind)
};

/// R_level_cam: rotates a ray of the tilted camera into the levelled one (same heading, Y along
/// gravity): R_x(pitch_up) R_z(roll_right).
[[nodiscard]] Eigen::Matrix3d levelling_rotation(const Tilt& tilt);

/// The tilt of a camera that sees this direction, of any length, point straight down.
[[nodiscard]] Tilt tilt_from_down(const Eigen::Vector3d& down);

/// The tilt of a camera whose frame is seen by the vehicle (X forward, Y left, Z up) as
/// R_vehicle_cam, camera axes X right, Y down, Z forward.
[[nodiscard]] Tilt tilt_from_mounting(const Eigen::Matrix3d& R_vehicle_cam);

/// A motion of levelled cameras, T_2_1 = (R, t), as the tilted cameras see it: Lᵀ R L, Lᵀ t.
[[nodiscard]] RelativePose unlevel(const RelativePose& T_level, const Eigen::Matrix3d& R_level_cam);

/// The inverse of unlevel.
[[nodiscard]] RelativePose level(const RelativePose& T_cam, const Eigen::Matrix3d& R_level_cam);

}  // namespace oneac
