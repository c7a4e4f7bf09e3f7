#pragma once

#include "oneac/features/correspondence.h"
#include "oneac/geometry/camera_frame.h"

namespace oneac {

/// The pair [px] with depths of its second points, measured in the right image of the frame: of
/// some hundred spread over the tracks, of none without a right image, and of none where
/// `right_mask` is dark.
[[nodiscard]] TrackedPair with_stereo_depths(TrackedPair pair, const CameraFrame& frame);

}  // namespace oneac
