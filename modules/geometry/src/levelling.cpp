#include "oneac/geometry/levelling.h"

#include <cmath>

namespace oneac {

Eigen::Matrix3d levelling_rotation(const Tilt& tilt) {
  return pitch_rotation(tilt.pitch_up) * roll_rotation(tilt.roll_right);
}

Tilt tilt_from_down(const Eigen::Vector3d& down) {
  // Lᵀ (0, 1, 0) for L = Rx(p) Rz(r) is (sin r cos p, cos r cos p, -sin p).
  // + 0.0: a level camera has a roll of 0, not of -0.
  return {std::atan2(-down.z(), std::hypot(down.x(), down.y())),
          std::atan2(down.x() + 0.0, down.y())};
}

Tilt tilt_from_mounting(const Eigen::Matrix3d& R_vehicle_cam) {
  return tilt_from_down(-R_vehicle_cam.row(2).transpose());
}

RelativePose unlevel(const RelativePose& T_level, const Eigen::Matrix3d& R_level_cam) {
  return {R_level_cam.transpose() * T_level.R * R_level_cam, R_level_cam.transpose() * T_level.t};
}

RelativePose level(const RelativePose& T_cam, const Eigen::Matrix3d& R_level_cam) {
  return {R_level_cam * T_cam.R * R_level_cam.transpose(), R_level_cam * T_cam.t};
}

}  // namespace oneac
