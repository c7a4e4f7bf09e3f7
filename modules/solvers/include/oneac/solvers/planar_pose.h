#pragma once

#include "oneac/geometry/relative_pose.h"

namespace oneac {

/// Planar motion: yaw by α about the vertical (Y) axis and a translation in the XZ plane.
struct PlanarPose {
  double cos_alpha = 1.0;
  double sin_alpha = 0.0;
  double tx = 0.0;  ///< unit: see the solver
  double tz = 0.0;  ///< unit: see the solver

  /// R of eq. (2) and t = (tx, 0, tz).
  [[nodiscard]] RelativePose pose() const {
    return {yaw_rotation(cos_alpha, sin_alpha), {tx, 0.0, tz}};
  }
};

}  // namespace oneac
