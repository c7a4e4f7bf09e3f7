#pragma once

#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

namespace oneac {

/// Homography from four or more points: the normalised direct linear transform.
///
/// Model: x2 ~ H x1, two rows per point, eq. (4) of Gal 2020; Hartley and Zisserman, algorithm 4.2.
/// Four points are solved exactly, more in algebraic least squares. docs/solvers/homography_4pc.md
/// @param points  N ≥ 4; of their affinities only a mirror image
///                (det A < 0) counts, which is refused
/// @return        at most one H, scaled to a middle singular value of one and such that x2ᵀ H x1 >
///                0 for most points, ready for decompose_homography
/// @degenerate    three of four points on a line, coincident points, singular H, a rotation (no
///                motion: the points say nothing about a plane), mirrored, not finite: empty
/// @cost          about 1.5 µs for four, no allocation; pure, thread-safe
[[nodiscard]] SolutionSet<Eigen::Matrix3d, 1> homography_4pc(AcSpan points,
                                                             const double* weights = nullptr);

}  // namespace oneac
