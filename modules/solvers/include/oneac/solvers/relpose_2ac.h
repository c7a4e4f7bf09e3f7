#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

namespace oneac {

/// Relative pose of any motion from two affine correspondences on any surfaces, coplanar or not.
///
/// Model: each gives the epipolar and two affine-epipolar equations, linear in E: six for five
/// unknowns. The five that say most are solved exactly with the ten cubics of an essential matrix,
/// as essential_5pc does; the sixth chooses, and the nearest motions are polished on all six, the
/// affine ones weighted by the radius of a patch. docs/solvers/relpose_2ac.md
/// Source: two correspondences suffice by Barath and Hajder, "Efficient recovery of essential
/// matrix from two affine correspondences", 2018, and Eichhardt and Chetverikov, "Affine
/// correspondences between central cameras for rapid relative pose estimation", ECCV 2018, who use
/// all six at once; the choice of five and one is our own.
/// @param acs   exactly the first two are used; normalised image points [-], A: ∂x2/∂x1 [-]
/// @return      up to four poses T_2_1 in the order of their residual, |t| = 1, each with both
///              points before both cameras; two of equal residual when both lie on one plane
/// @degenerate  pure rotation, no motion, coincident points, det A ≤ 0, not finite: empty
/// @cost        about 8 µs, no allocation; pure, thread-safe
[[nodiscard]] SolutionSet<RelativePose, 4> relpose_2ac(AcSpan acs);

/// Algebraic least squares over N ≥ 2 correspondences on any surfaces; `weights` (one each, ≥ 0)
/// may be null. Descends from the solutions of up to eight pairs of neighbours in the list; the
/// least cost wins, and the sign of t follows the majority of the points. Of two: as relpose_2ac.
[[nodiscard]] SolutionSet<RelativePose, 4> relpose_nac(AcSpan acs, const double* weights = nullptr);

}  // namespace oneac
