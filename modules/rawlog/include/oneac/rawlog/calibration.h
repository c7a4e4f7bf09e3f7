#pragma once

#include "oneac/geometry/camera.h"

#include <string>

namespace oneac {

/// Reads a camera's calibration from a file of one of three kinds, told apart by their content:
/// - sections with resolution, cx, cy, fx, fy and dist (k1 k2 p1 p2 k3), as in the Málaga dataset's
///   camera_params_*.txt and in MRPT's own camera sections;
/// - a KITTI calib.txt: lines "P0: " and twelve numbers; the image size is not in it (0).
///
/// @param file_and_section  FILE or FILE:SECTION. Without a section: the only one there is, else
///                          the only one named after the preferred side, P0 in a calib.txt
/// @param preferred_side    "left", "right" or ""
/// @throws InputError when there is no such file, no such section (those that exist are
///         listed), the choice is open, a value is missing or not a number, or the lens
///         model is not plumb-bob
[[nodiscard]] PinholeCamera load_calibration(const std::string& file_and_section,
                                             const std::string& preferred_side);

}  // namespace oneac
