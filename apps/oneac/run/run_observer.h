#pragma once

#include "drive_record.h"

#include "oneac/features/ac_tracker.h"
#include "oneac/geometry/camera_frame.h"

#include <functional>

namespace oneac::app {

/// What a viewer is shown after each frame; valid during the call.
struct RunMoment {
  const GreyImage& image;
  const TrackedPair& pair;                 ///< [px] from the frame before
  const DriveRecord& record;               ///< with this frame
  std::optional<NewestKeyframe> keyframe;  ///< when it is one
};

/// Looks on; changes no result.
using RunObserver = std::function<void(const RunMoment&)>;

}  // namespace oneac::app
