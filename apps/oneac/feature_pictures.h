#pragma once

#include "feature_statistics.h"

#include <filesystem>

namespace oneac::app {

/// Writes an image of the drive with the median affine residual of each region as colour and
/// number, from green (0.005 or less) to red (0.05 or more); regions with few values stay grey.
/// @throws OutputError
void draw_regions(const GreyImage& image, const FeatureStatistics& statistics,
                  const std::filesystem::path& png);

}  // namespace oneac::app
