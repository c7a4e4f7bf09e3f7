#pragma once

#include "oneac/frontend/frame_result.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace oneac {

/// Where the camera was in one frame.
struct FramePose {
  std::size_t index = 0;  ///< image of the camera in the log
  double time_s = 0.0;    ///< Unix time [s]
  /// Camera in the first camera's frame; final when settled, else as known when the frame came.
  Eigen::Isometry3d T_first_cam = Eigen::Isometry3d::Identity();
  bool settled = false;
};

/// The poses of a drive, each as good as it is known: what the results say when the frames come,
/// replaced by what later results make final.
class DriveTrajectory {
 public:
  /// Takes the frame of the result, and what the result settles.
  void add(const FrameResult& result);
  /// Takes what FrontEnd::finish() settles; nothing that was added before it changes any more.
  void finish(const Settled& settled);
  /// One per frame, in order of time.
  [[nodiscard]] const std::vector<FramePose>& poses() const { return poses_; }

 private:
  void settle(const Settled& settled);

  std::vector<FramePose> poses_;
};

}  // namespace oneac
