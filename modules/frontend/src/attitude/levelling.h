#pragma once

#include <Eigen/Core>

namespace oneac {

/// The rotation that removes a camera's tilt against its road, and how well it is known.
struct Levelling {
  Eigen::Matrix3d R_level_cam = Eigen::Matrix3d::Identity();
  double pitch_sigma = 0.0;  ///< [rad] 1σ
  double roll_sigma = 0.0;   ///< [rad] 1σ
};

}  // namespace oneac
