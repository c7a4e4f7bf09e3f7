#pragma once

#include "oneac/features/correspondence.h"
#include "oneac/geometry/camera_frame.h"

namespace oneac {

/// The pair in normalised image units, with the grey levels of the second image (0 without image).
/// @param pair  [px], of images with the cameras `first` and that of `second`
[[nodiscard]] TrackedPair normalised(const TrackedPair& pair, const PinholeCamera& first,
                                     const CameraFrame& second);

}  // namespace oneac
