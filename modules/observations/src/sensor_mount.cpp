#include "oneac/observations/sensor_mount.h"

#include "oneac/base/error.h"
#include "oneac/base/require.h"
#include "oneac/geometry/angles.h"
#include "oneac/geometry/camera_frame.h"
#include "oneac/geometry/levelling.h"

#include <algorithm>
#include <cmath>

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

// How far the camera looks along the vehicle, ahead or back; 0 is sideways, up or down.
double along_vehicle(const Eigen::Matrix3d& R_vehicle_cam) {
  return std::abs(R_vehicle_cam(0, 2));
}

// cos 45°: a lower edge that points further down is that of an upright camera.
constexpr double kUpright = 0.7;
// Readings whose directions of view differ by less than this along the vehicle do not tell.
constexpr double kSureDifference = 0.25;

SensorMount guessed(const SensorMount& optical, const SensorMount& x_forward) {
  const Eigen::Matrix3d& A = optical.T_vehicle_cam.linear();
  const Eigen::Matrix3d& B = x_forward.T_vehicle_cam.linear();
  const double down_a = down_axis_z(A), down_b = down_axis_z(B);
  if (std::min(down_a, down_b) < -kUpright) return down_a <= down_b ? optical : x_forward;
  const double lead = along_vehicle(A) - along_vehicle(B);
  SensorMount mount = lead >= 0.0 ? optical : x_forward;
  mount.sure = std::abs(lead) > kSureDifference;
  return mount;
}

}  // namespace

void MountAngles::validate() const {
  // The comparisons are false for NaN.
  require(std::abs(roll_right_deg) <= 360.0, "mount_roll_deg", roll_right_deg, "from -360 to 360");
  require(std::abs(pitch_up_deg) <= 90.0, "mount_pitch_deg", pitch_up_deg, "from -90 to 90");
  require(std::abs(yaw_left_deg) <= 360.0, "mount_yaw_deg", yaw_left_deg, "from -360 to 360");
}

Eigen::Matrix3d mount_rotation(const MountAngles& angles) {
  const Eigen::AngleAxisd yaw(angles.yaw_left_deg * kDegree, Eigen::Vector3d::UnitZ());
  return yaw.toRotationMatrix() * CameraFrame::forward_looking_mount().linear() *
         levelling_rotation({angles.pitch_up_deg * kDegree, angles.roll_right_deg * kDegree});
}

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
  const SensorMount as_optical{T_vehicle_sensor, MountConvention::optical, true};
  const SensorMount as_x_forward{T_x_forward, MountConvention::x_forward, true};
  if (convention == "auto") return guessed(as_optical, as_x_forward);
  return convention == "optical" ? as_optical : as_x_forward;
}

}  // namespace oneac
