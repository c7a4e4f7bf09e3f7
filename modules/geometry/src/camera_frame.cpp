#include "oneac/geometry/camera_frame.h"

namespace oneac {

Eigen::Isometry3d CameraFrame::forward_looking_mount() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return T;
}

}  // namespace oneac
