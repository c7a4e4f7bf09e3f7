#pragma once

#include "oneac/observations/sensor_mount.h"
#include "oneac/rawlog/import_report.h"

#include <filesystem>
#include <optional>
#include <string>

namespace oneac {

/// What an import of a camera's images is told, whatever their layout.
struct DriveImport {
  std::filesystem::path source;  ///< folder, or file of a video
  std::filesystem::path log;     ///< rawlog to write
  bool copy_images = false;      ///< copy to <log base>_Images instead of referring to them
  std::string calibration;       ///< FILE[:SECTION]; "": that of the layout, where it has one
  std::optional<double> camera_height_m;  ///< above the road [m]; none: the log tells no height
  MountAngles mount;                      ///< orientation of the camera; zeros: level, ahead
  MountConvention convention = MountConvention::optical;  ///< in which the log stores it
  std::optional<double> fps;  ///< stamps at this rate instead of the source's own times [1/s]
};

/// A part of a video, and the GPS of its drive.
struct VideoImport : DriveImport {
  double from_s = 0.0;                   ///< first frame at or after this time of the video [s]
  std::optional<double> to_s;            ///< last frame before it [s]; none: to the end
  std::filesystem::path nmea, gpx, csv;  ///< positions of a receiver; one of them, or none
  std::string start;  ///< of the video: Unix time, or 2024-05-01T10:00:00Z; "": the first fix's
};

// Each writes a rawlog with an image observation per image, in time order, its calibration scaled
// to the images where only their size differs. @throws InputError naming file, record or flag, what
// is wrong with it and the cure; OutputError when the log cannot be written

/// Images of any names in a folder, numbers in them by their value. Times: `fps`, else times.txt
/// beside the images (a row per image, in s, ms, us or ns), else the names where all of them hold
/// the time since 1970 in s, ms, us or ns; else those of EXIF. `calibration` must be given.
ImportReport import_image_folder(const DriveImport& options);

/// The frames of a video, decoded to <log base>_Images as PNG files, turned as it says; times:
/// `fps`, else those of the video's frames. A note counts those that are damaged or missing.
/// `calibration` must be given. GPS of another file is written beside them, from a second before
/// the first frame to a second after the last; without `start` the video is taken to begin with its
/// first fix, and a note says so.
ImportReport import_video(const VideoImport& options);

/// A drive of KITTI's raw data: image_00/data with image_00/timestamps.txt (image_02 without it),
/// calib_cam_to_cam.txt beside or above the drive (P_rect for images of its size, K for raw ones),
/// the right images of a rectified pair (image_01, image_03), GPS and IMU of oxts. Without a height
/// 1.65 m, KITTI's own.
ImportReport import_kitti_raw(const DriveImport& options);

/// Whether a folder is laid out as a drive of KITTI's raw data.
[[nodiscard]] bool is_kitti_raw(const std::filesystem::path& source);

/// An EuRoC sequence, or its mav0: cam0 with data.csv, data and sensor.yaml. Its IMU is left out:
/// its axes are not the vehicle's.
ImportReport import_euroc(const DriveImport& options);

/// A TUM RGB-D sequence: rgb.txt (time and name of each image). `calibration` must be given.
ImportReport import_tum(const DriveImport& options);

}  // namespace oneac
