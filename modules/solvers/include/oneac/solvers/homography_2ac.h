#pragma once

#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

namespace oneac {

/// Homography from two or more affine correspondences in algebraic least squares (Barath and
/// Hajder, "A theory of point-wise homography estimation", 2017).
///
/// Model: six rows each, eqs. (4) and (5) of Gal 2020, after Hartley's normalisation of both views.
/// docs/solvers/homography_2ac.md
/// @param acs   N ≥ 2 correspondences on one plane
/// @return      at most one H, scaled and signed as homography_4pc
/// @degenerate  fewer than two places, nothing but the horizon (y = 0), det A ≤ 0, singular H, a
///              rotation, not finite: empty
/// @cost        about 5 µs for two, no allocation; pure, thread-safe
[[nodiscard]] SolutionSet<Eigen::Matrix3d, 1> homography_2ac(AcSpan acs,
                                                             const double* weights = nullptr);

}  // namespace oneac
