#pragma once

#include "oneac/solvers/planar_pose.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

namespace oneac {

/// Relative pose of a camera in planar motion from one affine correspondence on the ground,
/// least squares under cos²α + sin²α = 1 (the paper's "optimal" solver).
///
/// Model: A_gd (cos α, sin α, p, q)ᵀ = b, p = t_x/d, q = t_z/d    [Gal 2020, eq. (9)],
/// docs/solvers/relpose_1ac_ground.md p and q are eliminated linearly; the global minimum on the
/// circle is a root of a secular equation.
/// @param ac   x1, x2: normalised image points [-]; A: ∂x2/∂x1 [-]; Y axis along
///             gravity in both views
/// @return     at most one pose T_2_1; (tx, tz) in units of the camera height, sign included
/// @degenerate y below kHorizon or at or behind the camera plane, det A ≤ 0, no
///             motion, not finite: empty
/// @cost       about 110 ns, no allocation; pure, thread-safe
[[nodiscard]] SolutionSet<PlanarPose, 1> relpose_1ac_ground(const AffineCorrespondence& ac);

/// The same from N ≥ 1 correspondences on the ground in least squares; `weights` (one each, ≥ 0)
/// may be null. Correspondences that cannot lie on the ground are left out.
[[nodiscard]] SolutionSet<PlanarPose, 1> relpose_nac_ground(AcSpan acs,
                                                            const double* weights = nullptr);

/// The paper's "rapid" solver: null vector of [A_gd | −b].
///
/// Erratum: division by the last entry does not normalise (cos α, sin α); it is done
/// explicitly here, and p, q keep the scale that the division gives them. Parameters, result,
/// degeneracies as relpose_1ac_ground.
[[nodiscard]] SolutionSet<PlanarPose, 1> relpose_1ac_ground_rapid(const AffineCorrespondence& ac);

/// The rapid solver on N ≥ 1 correspondences.
[[nodiscard]] SolutionSet<PlanarPose, 1> relpose_nac_ground_rapid(AcSpan acs,
                                                                  const double* weights = nullptr);

/// Smallest y of a ground point [-]: at 0.5° under the horizon the plane's parallax is less than a
/// hundredth of that of the road right before the car, so the correspondence says nothing about it.
constexpr double kHorizon = 0.0087;

}  // namespace oneac
