#pragma once

#include "oneac/geometry/affine_correspondence.h"

namespace oneac::internal {

/// Finite points; the affinity is not looked at.
[[nodiscard]] inline bool has_points(const AffineCorrespondence& ac) {
  return ac.x1.allFinite() && ac.x2.allFinite();
}

/// Finite, not mirrored.
[[nodiscard]] inline bool is_usable(const AffineCorrespondence& ac) {
  return ac.is_finite() && ac.A.determinant() > 0.0;
}

}  // namespace oneac::internal
