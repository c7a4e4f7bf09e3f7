#pragma once

#include "run_observer.h"

#include <memory>

namespace oneac::app {

/// A window with the vehicle's way, keyframes, landmarks, the camera, and its image with the affine
/// correspondences, in words the frame, the distance, whether it is in metres, and a legend. The
/// user may close it at any time; the run goes on.
class RunGui {
 public:
  /// @throws InputError when the program was built without windows, or there is no display
  RunGui();
  ~RunGui();
  RunGui(const RunGui&) = delete;
  RunGui& operator=(const RunGui&) = delete;

  void show(const RunMoment& moment);
  /// Draws the finished drive, then returns when the user closes the window or interrupts.
  void wait(const DriveRecord& record);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace oneac::app
