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
  bool sure = true;  ///< false: "auto" had to choose between two readings equally likely
};

/// How somebody says that a camera looks, instead of the log: turned from a level camera that looks
/// ahead by yaw, then pitch, then roll.
struct MountAngles {
  double roll_right_deg = 0.0;  ///< [deg] about the optical axis, right side down; 180: upside down
  double pitch_up_deg = 0.0;    ///< [deg] optical axis above the horizon
  double yaw_left_deg = 0.0;    ///< [deg] to the left; 180: a rear camera

  /// @throws std::invalid_argument naming field, value and bound: within ±360°, pitch within ±90°
  void validate() const;
};

/// R_vehicle_cam of the optical frame: R_z(yaw) · forward-looking · R_x(pitch) R_z(roll).
/// @pre the angles are finite
[[nodiscard]] Eigen::Matrix3d mount_rotation(const MountAngles& angles);

/// Reads the pose of a camera as stored in a log.
///
/// "auto" takes the convention under which the lower edge of the images points down. Where it does
/// under neither, as with a camera upside down or on its side, it takes the one under which the
/// camera looks along the vehicle rather than beside, above or below; `sure` is false when that
/// does not tell either. (A camera on its side stored x-forward can look like an upright side
/// camera stored optically: then the drive shows that it does not travel where it should.)
/// @param T_vehicle_sensor  pose of the sensor frame in the vehicle frame
/// @param convention        "optical", "x_forward" or "auto"
/// @throws InputError on any other convention, or a pose that is not finite
[[nodiscard]] SensorMount mount_from_sensor_pose(const Eigen::Isometry3d& T_vehicle_sensor,
                                                 const std::string& convention = "auto");

}  // namespace oneac
