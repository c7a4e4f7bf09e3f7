#pragma once

#include "oneac/observations/sensor_mount.h"
#include "oneac/rawlog/import_report.h"

#include <filesystem>
#include <optional>

namespace oneac {

/// An extract of the Málaga Urban Dataset, or a part of it.
struct MalagaImport {
  std::filesystem::path
      source;  ///< holds Images, *_Images or the images themselves, and the text files
  std::filesystem::path log;         ///< rawlog to write
  bool copy_images = false;          ///< copy to <log base>_Images instead of referring to them
  std::optional<MountAngles> mount;  ///< orientation of the left camera; none: the dataset's
  MountConvention convention = MountConvention::x_forward;  ///< in which the log stores it
};

/// Writes the extract as a rawlog: a CObservationStereoImages per pair
/// `img_<label>_<time>_left|right`, either side of which may be missing; GPS and IMU from
/// `*_GPS.txt` and `*_IMU.txt`, in time order. The calibration is that of `camera_params_*.txt` for
/// the size of the images, a rectified one before a raw one. The camera sits where the dataset's
/// own logs say: (0.785, 0, 0.273) m, 8.2° upwards, stored x-forward.
/// @throws InputError naming file or folder, what is wrong with it and the cure
ImportReport import_malaga(const MalagaImport& options);

}  // namespace oneac
