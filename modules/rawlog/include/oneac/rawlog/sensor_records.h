#pragma once

#include "oneac/geometry/camera.h"
#include "oneac/observations/sensor_mount.h"

#include <Eigen/Geometry>

#include <optional>
#include <string>

namespace oneac {

/// One image of one camera, kept in a file of its own.
struct ImageRecord {
  double time_s = 0.0;  ///< Unix time [s]
  std::string label;
  PinholeCamera camera;
  Eigen::Isometry3d T_vehicle_cam =
      Eigen::Isometry3d::Identity();                      ///< optical axes, see SensorMount
  MountConvention convention = MountConvention::optical;  ///< in which to store the pose
  std::string file;  ///< absolute, or relative to the log's folder of images
};

/// A pair of images, each kept in a file of its own.
struct StereoRecord {
  double time_s = 0.0;  ///< Unix time [s]
  std::string label;
  PinholeCamera left;
  PinholeCamera right;
  Eigen::Isometry3d T_vehicle_left = Eigen::Isometry3d::Identity();  ///< optical axes
  Eigen::Isometry3d T_left_right = Eigen::Isometry3d::Identity();    ///< optical axes of both
  MountConvention convention = MountConvention::optical;             ///< of T_vehicle_left
  std::string left_file;   ///< may be missing on disk, must be named
  std::string right_file;  ///< empty: there is none
};

/// A position on the WGS84 ellipsoid.
struct GeodeticPosition {
  double latitude_deg = 0.0;   ///< north positive [deg]
  double longitude_deg = 0.0;  ///< east positive [deg]
  double altitude_m = 0.0;     ///< [m]
};

/// Speed over ground and its direction.
struct GroundVelocity {
  double speed_mps = 0.0;   ///< [m/s]
  double course_deg = 0.0;  ///< from north, clockwise [deg]
};

/// What a GPS receiver says once per epoch.
struct GpsRecord {
  double time_s = 0.0;  ///< Unix time [s]
  std::string label;
  Eigen::Vector3d antenna = Eigen::Vector3d::Zero();  ///< in the vehicle frame [m]
  GeodeticPosition position;
  int fix_quality = 1;  ///< NMEA: 0 none, 1 GPS, 2 differential …
  int satellites = 0;
  std::optional<GroundVelocity> velocity;
};

/// Accelerations and rates of an inertial unit, its axes along the vehicle's.
struct ImuRecord {
  double time_s = 0.0;  ///< Unix time [s]
  std::string label;
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< specific force [m/s²]
  Eigen::Vector3d angular_rate = Eigen::Vector3d::Zero();  ///< about X, Y, Z [rad/s]
};

/// Where a vehicle is by its wheels, from anywhere on.
struct OdometryRecord {
  double time_s = 0.0;  ///< Unix time [s]
  std::string label;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< [m]
  double heading = 0.0;                                ///< positive to the left [rad]
};

/// The point at east, north, up [m] from an origin on the WGS84 ellipsoid.
[[nodiscard]] GeodeticPosition geodetic_from_enu(const Eigen::Vector3d& enu,
                                                 const GeodeticPosition& origin);

}  // namespace oneac
