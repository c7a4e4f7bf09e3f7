#pragma once

#include "klt_track.h"

#include <vector>

namespace oneac::internal {

/// Whether the second image shows the tracks where the first did: a sample of them, spread over the
/// list, keeps its place with a median shift below `standing_px`.
[[nodiscard]] bool is_standing(const std::vector<KltTrack>& tracks, const ImagePyramid& first,
                               const ImagePyramid& second, double standing_px);

}  // namespace oneac::internal
