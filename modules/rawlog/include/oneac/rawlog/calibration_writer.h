#pragma once

#include "oneac/geometry/camera.h"

#include <string>
#include <vector>

namespace oneac {

/// The section [CAMERA_PARAMS] of MRPT's camera files, which load_calibration() reads back to the
/// last digit: resolution, cx, cy, fx, fy, dist (k1 k2 p1 p2 k3).
/// @param remarks  lines above it, without "//"
[[nodiscard]] std::string calibration_text(const PinholeCamera& camera,
                                           const std::vector<std::string>& remarks);

}  // namespace oneac
