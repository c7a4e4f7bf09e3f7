#pragma once

#include "feature_statistics.h"

#include <filesystem>

namespace oneac::app {

/// Writes an image with the tracks that end in it, coloured by the σ of their affinity: from blue
/// (0.01 or less) to orange (0.05 or more), as in the reports of `run` and `compare`.
/// @throws OutputError
void draw_tracks(const ImageView& image, const TrackedPair& pair, const std::filesystem::path& png);

/// Writes an image of the drive with the median affine residual of each region as colour and
/// number, from blue (0.005 or less) to orange (0.05 or more); regions with few values stay grey.
/// @throws OutputError
void draw_regions(const GreyImage& image, const FeatureStatistics& statistics,
                  const std::filesystem::path& png);

}  // namespace oneac::app
