#pragma once

#include "oneac/geometry/relative_pose.h"

#include <Eigen/Geometry>

namespace oneac {

/// A pose that is the product of many, its rotation made one again.
[[nodiscard]] inline RelativePose orthonormalised(const RelativePose& T) {
  return {Eigen::Quaterniond(T.R).normalized().toRotationMatrix(), T.t};
}

/// Where a camera is, of the pose T_cam_frame that takes points of the frame to it.
[[nodiscard]] inline Eigen::Isometry3d camera_in_frame(const RelativePose& T_cam_frame) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = T_cam_frame.R.transpose();
  T.translation() = -(T.linear() * T_cam_frame.t);
  return T;
}

}  // namespace oneac
