#pragma once

#include "track_store.h"

#include "oneac/features/ac_tracker.h"
#include "oneac/geometry/camera_frame.h"

namespace oneac {

/// Measures depths of the pair's second points in the right image of the frame, of some hundred
/// spread over the tracks; without a right image nothing is done.
void add_stereo_depths(const CameraFrame& frame, const TrackedPair& pair, StepTracks& step);

}  // namespace oneac
