#pragma once

#include "oneac/geometry/camera.h"
#include "oneac/rawlog/sensor_records.h"

#include <Eigen/Geometry>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// Calibration of a pair of cameras.
struct StereoCalibration {
  std::string file;  ///< where it is from
  PinholeCamera left;
  PinholeCamera right;
  Eigen::Isometry3d T_left_right = Eigen::Isometry3d::Identity();  ///< optical axes [m]
  bool has_pose = false;  ///< false: the file has no *LEFT2RIGHT_POSE section
};

/// The camera_params_*.txt of a folder made for an image size, a rectified one before a raw one.
/// @throws InputError when there is none (those that exist are listed with their sizes)
[[nodiscard]] StereoCalibration find_malaga_calibration(const std::filesystem::path& source,
                                                        int width, int height);

/// The only file of a folder with this ending; the first by name when there are several.
[[nodiscard]] std::optional<std::filesystem::path> find_by_ending(
    const std::filesystem::path& folder, const std::string& ending);

/// Positions of a *_GPS.txt, and speed and course unless their columns are zero throughout (as in
/// the published extracts). @throws InputError naming file and line
[[nodiscard]] std::vector<GpsRecord> read_malaga_gps(const std::filesystem::path& file);

/// Accelerations and angular rates of an *_IMU.txt. @throws InputError naming file and line
[[nodiscard]] std::vector<ImuRecord> read_malaga_imu(const std::filesystem::path& file);

}  // namespace oneac
