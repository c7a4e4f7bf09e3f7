#pragma once

#include "oneac/solvers/planar_pose.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

namespace oneac {

/// Relative pose of a camera in planar motion from two points of any scene (Ortin
/// and Montiel 2001).
///
/// Model: two epipolar equations in e = (E12, E21, E23, E32) leave a pencil; E21² + E23² = E12² +
/// E32² is a quadratic on it. docs/solvers/relpose_2pc_planar.md
/// @param points  exactly two are used, the first two; of their affinities only a mirror image
///                (det A < 0) counts, which is refused
/// @return        up to two poses T_2_1, |t| = 1, signs such that the points lie
///                before both cameras
/// @degenerate    both on the horizon, coincident points, no motion, not finite: empty
/// @cost          about 450 ns, no allocation; pure, thread-safe
[[nodiscard]] SolutionSet<PlanarPose, 2> relpose_2pc_planar(AcSpan points);

}  // namespace oneac
