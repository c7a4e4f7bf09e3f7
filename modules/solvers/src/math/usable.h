#pragma once

#include "oneac/geometry/affine_correspondence.h"

namespace oneac::internal {

/// Finite points that may be a surface's. Of the affinity only the orientation counts, which is the
/// identity's where there is none: a negative determinant is a mirror image, and no camera sees a
/// surface from its back.
[[nodiscard]] inline bool has_points(const AffineCorrespondence& ac) {
  const bool mirrored = ac.A(0, 0) * ac.A(1, 1) < ac.A(0, 1) * ac.A(1, 0);
  return !mirrored && ac.x1.allFinite() && ac.x2.allFinite();
}

/// Finite, not mirrored.
[[nodiscard]] inline bool is_usable(const AffineCorrespondence& ac) {
  return ac.is_finite() && ac.A.determinant() > 0.0;
}

}  // namespace oneac::internal
