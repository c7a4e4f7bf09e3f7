#pragma once

#include "oneac/observations/camera_view.h"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace oneac {

/// Notices two cameras under one label by their sensor poses: those of four images in a row are A,
/// B, A, B. A camera that is turned or moved once is none.
class PoseWatch {
 public:
  /// The next image of the camera. @pre its pose is sound
  /// @throws InputError at the fourth such image
  void check(const CameraView& view, const std::string& where);

 private:
  std::vector<Eigen::Isometry3d> last_;  ///< up to three, newest last
};

}  // namespace oneac
