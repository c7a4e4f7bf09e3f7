#pragma once

#include "math/usable.h"

#include "oneac/solvers/relpose_1ac_ground.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"
#include "oneac/solvers/wall_pose.h"

#include <cmath>
#include <optional>

namespace oneac::internal {

/// The homography [h1 0 h3; 0 1 0; h7 0 h9].
struct WallHomography {
  double h1, h3, h7, h9;
};

/// What of the correspondences a solver uses.
enum class WallRows { kAffine, kPointsOnly };

/// On the horizon the equations in h7 lose their factor y'.
[[nodiscard]] inline bool may_lie_on_wall(const AffineCorrespondence& ac, WallRows rows) {
  return (rows == WallRows::kAffine ? is_usable(ac) : has_points(ac)) &&
         std::abs(ac.x1.y()) > kHorizon && std::abs(ac.x2.y()) > kHorizon;
}

/// A_vert h = 0 with h5 = 1 in least squares; empty when it is not determined.
[[nodiscard]] std::optional<WallHomography> wall_homography(AcSpan acs, const double* weights,
                                                            WallRows rows);

/// The two poses of a wall's homography, signs resolved by the points; eq. (11) and after.
[[nodiscard]] SolutionSet<WallPose, 2> poses_of_wall(const WallHomography& h, AcSpan acs,
                                                     const double* weights, WallRows rows);

}  // namespace oneac::internal
