#pragma once

#include "oneac/solvers/planar_pose.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

namespace oneac {

/// Relative pose of a car's camera from one point under the non-holonomic constraint: the rear
/// axle moves on a circle (Scaramuzza, "1-point-RANSAC structure from motion for
/// vehicle-mounted cameras", 2011).
///
/// Model: t ∝ (sin α/2, 0, −cos α/2), hence tan α/2 = (y' x − x' y) / (y' + y).
/// docs/solvers/relpose_1pc_ackermann.md
/// @param points  N ≥ 1 of any scene, least squares; of their affinities only a
///                mirror image (det A < 0) counts, which is refused. The camera is taken to sit
///                above the rear axle and to look along the car
/// @return        at most one pose T_2_1, |t| = 1; the sign (forwards, backwards)
///                from the points' depth
/// @degenerate    y = y' = 0, no motion, turning on the spot (y² / (1 + x²) stays in every
///                point), not finite: empty
/// @cost          about 50 ns for one, no allocation; pure, thread-safe
[[nodiscard]] SolutionSet<PlanarPose, 1> relpose_1pc_ackermann(AcSpan points,
                                                               const double* weights = nullptr);

}  // namespace oneac
