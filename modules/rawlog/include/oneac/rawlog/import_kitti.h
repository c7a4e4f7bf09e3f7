#pragma once

#include "oneac/observations/sensor_mount.h"
#include "oneac/rawlog/import_report.h"

#include <filesystem>
#include <optional>
#include <string>

namespace oneac {

/// A KITTI odometry sequence, or a folder in its layout.
struct KittiImport {
  std::filesystem::path
      source;                 ///< holds image_0, image_l, image_2 or images (png, jpg), calib.txt
  std::filesystem::path log;  ///< rawlog to write
  std::string calibration;    ///< FILE[:SECTION] instead of calib.txt; then no right images
  std::optional<double> fps;  ///< stamps at this rate instead of times.txt [1/s]
  bool copy_images = false;   ///< copy to <log base>_Images instead of referring to them
  std::optional<double> camera_height_m;  ///< above the road [m]; none: 1.65 m where the folder is
                                          ///< KITTI's, else the log tells no height
  MountAngles mount;                      ///< orientation of the camera; zeros: level, ahead
  MountConvention convention = MountConvention::optical;  ///< in which the log stores it
};

/// Writes the sequence as a rawlog: one CObservationImage per image, labelled with the image
/// folder's name, calibration of P0 (P2 for image_2) in calib.txt, sensor pose at the camera's
/// height. A folder is taken for KITTI's, and its cameras for 1.65 m high, when its focal length is
/// that of one of KITTI's days (707.09, 718.86, 721.54 px) and its images have KITTI's size (1224
/// to 1242 by 370 to 376); any other camera's height is unknown until somebody gives it. Rows of
/// times.txt (without it: 10 Hz) and poses.txt belong to the images by their numbers, or by their
/// order where the names are no numbers. poses.txt goes to <log base>_poses.txt.
/// Where image_1 is beside image_0 (image_3 beside image_2) and calib.txt has P1 (P3), a
/// CObservationStereoImages per pair with the baseline between the projections.
/// @throws InputError naming file or folder, what is wrong with it and the cure; for a height that
///         is none of a vehicle's camera (CameraHeight) or a mount out of bounds
ImportReport import_kitti(const KittiImport& options);

}  // namespace oneac
