#pragma once

#include "calibration/calibration_entry.h"

#include <filesystem>
#include <string>

namespace oneac {

/// The cameras of COLMAP's cameras.txt, by their ids: "1 OPENCV 1242 375 fx fy cx cy k1 k2 p1 p2".
/// COLMAP puts the corner of the image at 0; we the centre of its first pixel. Empty when it is
/// none.
[[nodiscard]] CalibrationEntries colmap_calibrations(const std::filesystem::path& file,
                                                     const std::string& text);

/// The cameras of KITTI's calib_cam_to_cam.txt: "P_rect_00" … of the rectified images with the size
/// S_rect_00, and "K_00" … with D_00 and S_00 of the raw ones. Empty when it is none.
[[nodiscard]] CalibrationEntries kitti_raw_calibrations(const std::filesystem::path& file,
                                                        const std::string& text);

}  // namespace oneac
