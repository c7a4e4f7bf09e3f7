#include "oneac/observations/sensor_mount.h"

#include "oneac/base/error.h"

namespace oneac {
namespace {

// Optical axes (X right, Y down, Z forward) in a frame with X forward, Y left, Z up.
Eigen::Matrix3d optical_in_x_forward() {
  Eigen::Matrix3d R;
  R << 0, 0, 1,  //
      -1, 0, 0,  //
      0, -1, 0;
  return R;
}

// How far the image's down axis points along the vehicle's Z; −1 is straight down.
double down_axis_z(const Eigen::Matrix3d& R_vehicle_cam) {
  return R_vehicle_cam(2, 1);
}

}  // namespace

std::string to_string(MountConvention convention) {
  return convention == MountConvention::optical ? "optical" : "x_forward";
}

SensorMount mount_from_sensor_pose(const Eigen::Isometry3d& T_vehicle_sensor,
                                   const std::string& convention) {
  if (!T_vehicle_sensor.matrix().allFinite()) {
    throw InputError("sensor pose", "it is not finite", "correct the pose stored in the log");
  }
  if (convention != "auto" && convention != "optical" && convention != "x_forward") {
    throw InputError("mount convention '" + convention + "'", "there is no such convention",
                     "use auto, optical or x_forward");
  }
  Eigen::Isometry3d T_x_forward = T_vehicle_sensor;
  T_x_forward.linear() = T_vehicle_sensor.linear() * optical_in_x_forward();
  const bool optical =
      convention == "optical" || (convention == "auto" && down_axis_z(T_vehicle_sensor.linear()) <=
                                                              down_axis_z(T_x_forward.linear()));
  if (optical) return {T_vehicle_sensor, MountConvention::optical};
  return {T_x_forward, MountConvention::x_forward};
}

}  // namespace oneac
