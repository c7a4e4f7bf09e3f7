#include "oneac/frontend/drive_trajectory.h"

namespace oneac {

void DriveTrajectory::add(const FrameResult& result) {
  poses_.push_back({result.index, result.time_s, result.T_first_cam, false});
  settle(result.settled);
}

void DriveTrajectory::finish(const Settled& settled) {
  settle(settled);
  for (FramePose& pose : poses_) pose.settled = true;  // without a window they never were to move
}

void DriveTrajectory::settle(const Settled& settled) {
  for (const SettledFrame& frame : settled.frames) {
    if (frame.frame >= poses_.size()) continue;  // of a front-end that this did not follow
    poses_[frame.frame].T_first_cam = frame.T_first_cam;
    poses_[frame.frame].settled = true;
  }
}

}  // namespace oneac
