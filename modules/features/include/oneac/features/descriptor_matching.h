#pragma once

#include "oneac/features/affine_features.h"
#include "oneac/features/feature_options.h"
#include "oneac/geometry/affine_correspondence.h"

#include <vector>

namespace oneac {

/// Nearest-neighbour matches that pass the SNN ratio, the mutual check and the gates, in the
/// order of the first image's frames; A = shape2 shape1⁻¹. Of several matches that start or
/// end within a pixel of each other (frames of several orientations) only the one with the
/// closest descriptors stays.
[[nodiscard]] std::vector<AffineCorrespondence> match_features(const AffineFeatures& first,
                                                               const AffineFeatures& second,
                                                               const MatchOptions& options);

}  // namespace oneac
