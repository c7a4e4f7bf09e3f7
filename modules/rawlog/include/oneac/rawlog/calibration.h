#pragma once

#include "oneac/geometry/camera.h"

#include <string>

namespace oneac {

/// Reads a camera's calibration from a file, whose kind its content tells; a byte-order mark is
/// skipped:
/// - sections with resolution, cx, cy, fx, fy and dist, as in the Málaga dataset's
///   camera_params_*.txt and in MRPT's own camera sections (plumb_bob, kannala_brandt);
/// - KITTI: calib.txt with lines "P0: " and twelve numbers, without an image size (0), and
///   calib_cam_to_cam.txt with P_rect_00 … (rectified images) and K_00 … (raw ones);
/// - YAML of OpenCV, ROS (camera_info), Kalibr (camchain), EuRoC (sensor.yaml) and ORB-SLAM, and
///   OpenCV's XML;
/// - COLMAP's cameras.txt.
/// Lens models: plumb-bob and rational, Kannala-Brandt (equidistant, fisheye), none.
///
/// @param file_and_section  FILE or FILE:SECTION. Without a section: the only one there is, P0 or
///                          P_rect_00, else the only one named after the preferred side
/// @param preferred_side    "left", "right" or ""
/// @throws InputError when there is no such file, no such section (those that exist are
///         listed), the choice is open, a value is missing or not a number, or the lens
///         model is another
[[nodiscard]] PinholeCamera load_calibration(const std::string& file_and_section,
                                             const std::string& preferred_side);

}  // namespace oneac
