#pragma once

#include "oneac/solvers/planar_pose.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

namespace oneac {

/// Relative pose of a camera in planar motion from one affine correspondence on any surface.
///
/// Model: E = [t]× R has the four entries e = (E12, E21, E23, E32); the epipolar and the two
/// affine-epipolar equations form a 3×4 system B e = 0. docs/solvers/relpose_1ac_planar.md
/// t ∝ (E32, 0, −E12), and (cos α, sin α) follow from E21 = t_z c − t_x s, E23 = −t_z s − t_x c.
/// Source: Hajder and Barath, "Relative planar motion for vehicle-mounted cameras from a single
/// affine correspondence", ICRA 2020, arXiv 1912.06465; Guan, Zhao, Li, Sun, Fraundorfer, "Minimal
/// Solutions for Relative Pose with a Single Affine Correspondence", CVPR 2020, arXiv 1912.10776.
/// Theirs keep two angles as unknowns; here the null vector is taken and normalised.
/// @param ac   as relpose_1ac_ground; any plane, known or not
/// @return     at most one pose T_2_1; |t| = 1, its sign puts the point in front of both cameras
/// @degenerate rank(B) < 3, no motion, point behind a camera for either sign, det A ≤
///             0, not finite: empty
/// @cost       about 90 ns, no allocation; pure, thread-safe
[[nodiscard]] SolutionSet<PlanarPose, 1> relpose_1ac_planar(const AffineCorrespondence& ac);

/// The same from N ≥ 1 correspondences in (algebraic) least squares; `weights` may be null. The
/// sign of t follows the majority of the points.
[[nodiscard]] SolutionSet<PlanarPose, 1> relpose_nac_planar(AcSpan acs,
                                                            const double* weights = nullptr);

}  // namespace oneac
