#pragma once

#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

namespace oneac {

/// Essential matrices from five points, minimal.
///
/// Model: x2ᵀ E x1 = 0 five times, 2 E Eᵀ E = tr(E Eᵀ) E, det E = 0; Nistér, "An efficient
/// solution to the five-point relative pose problem", 2004: Gauss-Jordan elimination of the ten
/// cubics, a polynomial of degree ten by Sturm's theorem, then Gauss-Newton on the cubics for the
/// last digits. docs/solvers/essential_5pc.md
/// @param points  exactly the first five are used; of their affinities only a mirror image
///                (det A < 0) counts, which is refused
/// @return        up to ten E with |E| = √2
/// @degenerate    pure rotation, no motion, coincident points, not finite: empty. A
///                plane is no degeneracy
/// @cost          about 8 µs, no allocation; pure, thread-safe
[[nodiscard]] SolutionSet<Eigen::Matrix3d, 10> essential_5pc(AcSpan points);

}  // namespace oneac
