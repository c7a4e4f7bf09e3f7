#pragma once

#include "patch/patch_alignment.h"

#include "oneac/features/correspondence.h"

#include <cstdint>

namespace oneac::internal {

/// Rounded to single precision. Through memory: GCC 12 vectorises two such casts side by side away.
[[nodiscard]] inline double in_single_precision(double value) {
  const volatile float rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

/// A correspondence of a track with what its alignment tells of it. Sigmas and perspective are
/// estimates good to a digit or two: they are rounded to single precision.
[[nodiscard]] inline Correspondence with_quality(const AffineCorrespondence& ac,
                                                 std::uint64_t track,
                                                 const AlignmentQuality& quality) {
  Correspondence full;
  static_cast<AffineCorrespondence&>(full) = ac;
  full.track = track;
  full.point_sigma = in_single_precision(quality.point_sigma);
  full.affine_sigma = in_single_precision(quality.affine_sigma);
  full.perspective = quality.perspective.cast<float>().cast<double>();
  return full;
}

}  // namespace oneac::internal
