#pragma once

#include "oneac/base/image.h"

#include <cstdint>
#include <optional>

namespace oneac {

/// Notices images that repeat the one before, pixel by pixel. No sensor sees the same noise twice:
/// the camera froze, a video was stretched to another rate, or its encoder skipped a frame. Such an
/// image says nothing of the motion, least of all that the car stood.
class RepeatWatch {
 public:
  /// Whether this image has the pixels of the one before it; remembers it.
  [[nodiscard]] bool repeats(const ImageView& image);

 private:
  std::optional<std::uint64_t> before_;  ///< hash of size and pixels
};

}  // namespace oneac
