#pragma once

#include "run_loops.h"

#include "oneac/geometry/camera_frame.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace oneac::app {

/// The images of the keyframes of all logs, one log after the other: the logs once more.
class KeyframeImages {
 public:
  /// @throws InputError for a log that cannot be read again
  explicit KeyframeImages(const std::vector<RecordedDrive>& drives);
  ~KeyframeImages();
  KeyframeImages(const KeyframeImages&) = delete;
  KeyframeImages& operator=(const KeyframeImages&) = delete;

  /// Any thread. Empty for one that was not found. @throws InputError where the image has gone
  [[nodiscard]] CameraFrame load(std::size_t place) const;

 private:
  class OfLog;
  std::vector<std::unique_ptr<OfLog>> logs_;
};

}  // namespace oneac::app
