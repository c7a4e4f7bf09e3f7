#pragma once

#include "oneac/rawlog/import_report.h"

#include <filesystem>

namespace oneac {

/// A KITTI odometry sequence, or a folder in its layout.
struct KittiImport {
  std::filesystem::path
      source;                 ///< holds image_0, image_l, image_2 or images (png, jpg), calib.txt
  std::filesystem::path log;  ///< rawlog to write
  bool copy_images = false;   ///< copy to <log base>_Images instead of referring to them
  double camera_height_m = 1.65;  ///< above the road [m]; the mounting of KITTI's vehicle
};

/// Writes the sequence as a rawlog: one CObservationImage per image, labelled with the image
/// folder's name, calibration of P0 (P2 for image_2) in calib.txt, sensor pose with optical axes at
/// the camera's height. Rows of times.txt (without it: 10 Hz) and poses.txt belong to the images by
/// their numbers, or by their order where the names are no numbers. poses.txt goes to <log
/// base>_poses.txt.
/// @throws InputError naming file or folder, what is wrong with it and the cure
ImportReport import_kitti(const KittiImport& options);

}  // namespace oneac
