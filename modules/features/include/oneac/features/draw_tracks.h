#pragma once

#include "oneac/base/image.h"
#include "oneac/features/ac_tracker.h"

#include <filesystem>

namespace oneac {

/// Writes the second image of a pair with its correspondences as a PNG: a line from x1 to x2, and
/// around x2 the parallelogram that A makes of a square of the first image. Colours run from green
/// (A known to a hundredth or better, or without a σ) to red (to a twentieth or worse); blue frames
/// mark a standing pair.
/// @param half_side_px  half the side of that square
/// @throws OutputError when the file cannot be written
void draw_tracks(const ImageView& image, const TrackedPair& pair, const std::filesystem::path& png,
                 double half_side_px = 8.0);

}  // namespace oneac
