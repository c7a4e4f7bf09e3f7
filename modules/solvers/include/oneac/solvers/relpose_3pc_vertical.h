#pragma once

#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"
#include "oneac/solvers/wall_pose.h"

namespace oneac {

/// Relative pose of a camera in planar motion and the normal of a wall of any orientation from
/// three points on it, after Saurer et al., "Homography based egomotion estimation with a common
/// direction", for the motion model of eq. (2).
///
/// Model: the point rows of A_vert, h5 = 1, in least squares; then as relpose_1ac_wall.
/// docs/solvers/relpose_3pc_vertical.md
/// @param points  N ≥ 3; of their affinities only a mirror image
///                (det A < 0) counts, which is refused
/// @return        up to two poses T_2_1, t in units of the distance to the wall, n towards the wall
/// @degenerate    fewer than three points off the horizon, points on one vertical
///                line, no motion: empty
/// @cost          about 500 ns for three, no allocation; pure, thread-safe
[[nodiscard]] SolutionSet<WallPose, 2> relpose_3pc_vertical(AcSpan points,
                                                            const double* weights = nullptr);

}  // namespace oneac
