#pragma once

#include "local_map.h"

#include "oneac/refine/sliding_window.h"

#include <cstdint>
#include <deque>
#include <vector>

namespace oneac {

/// The window as modules/refine wants it, and which track each landmark is.
struct WindowExchange {
  SlidingWindow window;
  std::vector<std::uint64_t> tracks;
};

/// Keyframes and landmarks with at least two sightings; the longest tracks when there are too many.
[[nodiscard]] WindowExchange to_sliding_window(const std::deque<WindowKeyframe>& keyframes,
                                               const TrackMap& tracks,
                                               const WindowOptions& options);

/// Poses, depths and gradients after the adjustment.
void take_back(const WindowExchange& exchange, std::deque<WindowKeyframe>& keyframes,
               TrackMap& tracks);

}  // namespace oneac
