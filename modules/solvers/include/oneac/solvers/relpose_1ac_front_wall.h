#pragma once

#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"
#include "oneac/solvers/wall_pose.h"

namespace oneac {

/// Relative pose of a camera in planar motion from one affine correspondence on a wall
/// across the road, orthogonal to the first camera's optical axis,
/// least squares under cos²α + sin²α = 1 (the paper's "optimal" solver).
///
/// Model: A_v2 (cos α, sin α, −t_x/d, −t_z/d)ᵀ = b, n = (0, 0, 1), n·X = d    [Gal 2020, eq. (10)],
/// docs/solvers/relpose_1ac_front_wall.md
/// @param ac   x1, x2: normalised image points [-]; A: ∂x2/∂x1 [-]; Y axis along
///             gravity in both views
/// @return     at most one pose T_2_1; (tx, tz) in units of the distance to the wall, its sign and
///             the side of the wall follow from the point lying in front of the first camera
/// @degenerate y within kHorizon of zero, det A ≤ 0, no motion, not finite: empty
/// @cost       about 110 ns, no allocation; pure, thread-safe
[[nodiscard]] SolutionSet<WallPose, 1> relpose_1ac_front_wall(const AffineCorrespondence& ac);

/// The same from N ≥ 1 correspondences on one wall in least squares; `weights` (one each, ≥ 0) may
/// be null. Correspondences that cannot lie on such a wall are left out.
[[nodiscard]] SolutionSet<WallPose, 1> relpose_nac_front_wall(AcSpan acs,
                                                              const double* weights = nullptr);

/// The paper's "rapid" solver: null vector of the homogeneous system. Parameters, result and
/// degeneracies as relpose_1ac_front_wall.
[[nodiscard]] SolutionSet<WallPose, 1> relpose_1ac_front_wall_rapid(const AffineCorrespondence& ac);

/// The rapid solver on N ≥ 1 correspondences.
[[nodiscard]] SolutionSet<WallPose, 1> relpose_nac_front_wall_rapid(
    AcSpan acs, const double* weights = nullptr);

}  // namespace oneac
