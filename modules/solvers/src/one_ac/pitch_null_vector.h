#pragma once

#include "oneac/geometry/affine_correspondence.h"

namespace oneac::internal {

/// The null vector of the 3×4 system as polynomials in τ = tan θ, ascending: e12, and e21, e23, e32
/// over cos θ.
struct NullVector {
  double e12[4];
  double e21[3];
  double e23[3];
  double e32[3];
  double size;  // of the entries that the minors are made of, to judge the minors by
};

/// With v' = y' − τ, w = 1 + τ y' the columns of the system are (u y, a1 y, a2 y + u), (v' x, a3 x
/// + v', a4 x), (v', a3, a4), (w y, a3 τ y, a4 τ y + w); the second minus x times the third is (0,
/// v', 0).
[[nodiscard]] NullVector null_vector(const AffineCorrespondence& ac);

}  // namespace oneac::internal
