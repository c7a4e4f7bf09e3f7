#pragma once

#include "calibration/calibration_entry.h"
#include "calibration/flat_document.h"

namespace oneac {

/// The cameras of a YAML or XML document of OpenCV (camera_matrix, distortion_coefficients,
/// fisheye_model; M1 D1 M2 D2), ROS (camera_info, as a file and as `rostopic echo` prints it),
/// Kalibr (camchain), EuRoC (sensor.yaml) or ORB-SLAM (Camera.fx …, Camera1.fx …, LEFT.K …). Empty
/// when it is of none of them.
[[nodiscard]] CalibrationEntries document_calibrations(const FlatDocument& document);

/// Whether a text is meant to be YAML of one of them, and no other kind of calibration file.
[[nodiscard]] bool is_calibration_yaml(const std::filesystem::path& file, const std::string& text);

}  // namespace oneac
