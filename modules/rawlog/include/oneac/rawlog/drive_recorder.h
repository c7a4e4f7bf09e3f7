#pragma once

#include "oneac/base/image.h"
#include "oneac/geometry/camera.h"
#include "oneac/rawlog/sensor_records.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

namespace oneac {

/// Images of one instant; `right` is empty without stereo.
struct DriveImages {
  GreyImage left;
  GreyImage right;
};

/// A drive with known poses, to be written as a dataset. Times count from its start [s].
struct DriveRecording {
  PinholeCamera camera;                                             ///< rectified; of both sides
  Eigen::Isometry3d T_vehicle_cam = Eigen::Isometry3d::Identity();  ///< left camera, optical axes
  MountConvention convention = MountConvention::x_forward;          ///< as in the Málaga dataset
  double baseline_m = 0.0;  ///< of the stereo pair [m]; 0: one camera only

  std::vector<double> times_s;                 ///< of the frames, increasing
  std::vector<Eigen::Isometry3d> T_world_cam;  ///< true poses of the (left) camera, one per frame
  /// The images of frame i; called from several threads at once.
  std::function<DriveImages(std::size_t i)> images;
  std::vector<GpsRecord> gps;  ///< in time order; may run on past the last frame, as may imu
  std::vector<ImuRecord> imu;  ///< in time order
  std::vector<OdometryRecord> wheels;  ///< in time order

  double epoch_s = 1261229980.0;  ///< Unix time of the start [s]; 19 December 2009, Málaga's day
  int threads = 1;                ///< the files do not depend on it
  /// Called after each frame with the number done; false ends the drive there. May be empty.
  std::function<bool(std::size_t done)> keep_going;
};

/// What was written where.
struct RecordedDrive {
  std::filesystem::path log;
  std::filesystem::path images;
  std::filesystem::path poses;
};

/// Writes a drive in the layout of the Málaga dataset: `simulated.rawlog` (images as CAMERA1,
/// GPS, IMU and wheels in time order), `Images/img_CAMERA1_<Unix time>[_left|_right].jpg`, and
/// `poses.txt` (KITTI format: one 3×4 row per frame, camera with X right, Y down, Z forward,
/// first frame = identity).
/// @throws InputError when the folder cannot be written to, OutputError when a file cannot,
///         std::invalid_argument when the vectors differ in length
RecordedDrive record_drive(const DriveRecording& drive, const std::filesystem::path& folder);

}  // namespace oneac
