#pragma once

#include "oneac/solvers/planar_pose.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

namespace oneac {

/// Relative pose of a camera in planar motion from two points on the ground, after Saurer
/// et al., "Homography based egomotion estimation with a common direction", for the
/// motion model of eq. (2).
///
/// Model: the point rows of A_gd (cos α, sin α, p, q)ᵀ = b, four equations in three unknowns, least
/// squares under cos²α + sin²α = 1. docs/solvers/relpose_2pc_ground.md
/// @param points  N ≥ 2; of their affinities only a mirror image
///                (det A < 0) counts, which is refused
/// @return        at most one pose T_2_1; (tx, tz) in camera heights, sign included
/// @degenerate    fewer than two points under the horizon, coincident points, no
///                motion, not finite: empty
/// @cost          about 110 ns for two, no allocation; pure, thread-safe
[[nodiscard]] SolutionSet<PlanarPose, 1> relpose_2pc_ground(AcSpan points,
                                                            const double* weights = nullptr);

}  // namespace oneac
