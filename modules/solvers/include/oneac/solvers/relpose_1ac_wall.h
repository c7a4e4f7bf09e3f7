#pragma once

#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"
#include "oneac/solvers/wall_pose.h"

namespace oneac {

/// Relative pose of a camera in planar motion and the normal of the wall from one affine
/// correspondence on a vertical plane of any orientation.
///
/// Model: A_vert (h1, h3, h5, h7, h9)ᵀ = 0, h5 = 1    [Gal 2020, section 3.3],
/// docs/solvers/relpose_1ac_wall.md; the 2×2 block G = [h1 h3; h7 h9] = R₂ + (t/d) nᵀ keeps the
/// length of n⊥, which gives two normals.
/// @param ac   x1, x2: normalised image points [-]; A: ∂x2/∂x1 [-]; Y axis along
///             gravity in both views
/// @return     up to two poses T_2_1 (true one among them), each with the wall before both cameras;
///             t in units of the distance to the wall, n towards the wall
/// @degenerate y or y' within kHorizon of zero, det A ≤ 0, no motion, not finite: empty.
///             Motion along the normal: the two solutions meet, and their error is the
///             square root of the noise
/// @cost       about 100 ns, no allocation; pure, thread-safe
[[nodiscard]] SolutionSet<WallPose, 2> relpose_1ac_wall(const AffineCorrespondence& ac);

/// The same from N ≥ 1 correspondences on one wall in least squares; `weights` (one each, ≥ 0) may
/// be null. The side of the wall follows the majority of the points.
[[nodiscard]] SolutionSet<WallPose, 2> relpose_nac_wall(AcSpan acs,
                                                        const double* weights = nullptr);

/// All candidates of the paper, before cheirality: the two poses of relpose_1ac_wall and their
/// twins with both t and n turned around, which put the wall behind the cameras.
[[nodiscard]] SolutionSet<WallPose, 4> relpose_1ac_wall_candidates(const AffineCorrespondence& ac);

}  // namespace oneac
