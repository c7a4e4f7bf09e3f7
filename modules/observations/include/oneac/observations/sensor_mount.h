#pragma once

#include <Eigen/Geometry>

#include <string>

namespace oneac {

/// The axes of the frame in which a log states the pose of a camera.
enum class MountConvention {
  optical,  ///< X right, Y down, Z forward: yaw, pitch, roll −90°, 0, −90° for a camera that looks
            ///< ahead
  x_forward  ///< X forward, Y left, Z up: 0, 0, 0 for a camera that looks ahead
};

/// "optical" or "x_forward".
[[nodiscard]] std::string to_string(MountConvention convention);

/// Where a camera sits on the vehicle.
struct SensorMount {
  /// Camera (X right, Y down, Z forward) in the vehicle frame (X forward, Y left, Z up) [m].
  Eigen::Isometry3d T_vehicle_cam = Eigen::Isometry3d::Identity();
  MountConvention convention = MountConvention::optical;
};

/// Reads the pose of a camera as stored in a log.
///
/// @param T_vehicle_sensor  pose of the sensor frame in the vehicle frame
/// @param convention        "optical", "x_forward", or "auto": the one under which the lower edge
/// of
///                          the image points further down (a camera upside down needs to be told)
/// @throws InputError on any other convention, or a pose that is not finite
[[nodiscard]] SensorMount mount_from_sensor_pose(const Eigen::Isometry3d& T_vehicle_sensor,
                                                 const std::string& convention = "auto");

}  // namespace oneac
