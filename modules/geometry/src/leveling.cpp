#include "oneac/geometry/leveling.h"

#include <cmath>

namespace oneac {

Eigen::Matrix3d leveling_rotation(const Tilt& tilt) {
  return pitch_rotation(tilt.pitch_up) * roll_rotation(tilt.roll_right);
}

Tilt tilt_from_mounting(const Eigen::Matrix3d& R_vehicle_cam) {
  // Gravity, (0, 0, -1) for the vehicle, in the camera: g = Lᵀ (0, 1, 0) for L = Rx(p) Rz(r)
  //   = (sin r cos p, cos r cos p, -sin p).
  const Eigen::Vector3d g = -R_vehicle_cam.row(2).transpose();
  // + 0.0: a level camera has a roll of 0, not of -0.
  return {std::atan2(-g.z(), std::hypot(g.x(), g.y())), std::atan2(g.x() + 0.0, g.y())};
}

RelativePose unlevel(const RelativePose& T_level, const Eigen::Matrix3d& R_level_cam) {
  return {R_level_cam.transpose() * T_level.R * R_level_cam, R_level_cam.transpose() * T_level.t};
}

RelativePose level(const RelativePose& T_cam, const Eigen::Matrix3d& R_level_cam) {
  return {R_level_cam * T_cam.R * R_level_cam.transpose(), R_level_cam * T_cam.t};
}

}  // namespace oneac
