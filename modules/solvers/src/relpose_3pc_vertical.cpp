#include "oneac/solvers/relpose_3pc_vertical.h"

#include "wall_homography.h"

namespace oneac {

using internal::WallRows;

SolutionSet<WallPose, 2> relpose_3pc_vertical(AcSpan points, const double* weights) {
  int usable = 0;  // two points would do for h1, h3, h7, h9, but exactly, without a check
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool counts = weights == nullptr || weights[i] > 0.0;
    usable += counts && internal::may_lie_on_wall(points[i], WallRows::kPointsOnly) ? 1 : 0;
  }
  if (usable < 3) return {};
  const auto h = internal::wall_homography(points, weights, WallRows::kPointsOnly);
  if (!h) return {};
  return internal::poses_of_wall(*h, points, weights, WallRows::kPointsOnly);
}

}  // namespace oneac
