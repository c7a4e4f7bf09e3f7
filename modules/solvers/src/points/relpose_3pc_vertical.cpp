#include "oneac/solvers/relpose_3pc_vertical.h"

#include "planes/wall_homography.h"

#include <algorithm>

namespace oneac {

using internal::WallRows;

namespace {

// Points whose x [-] differ by less lie on one vertical line, where each gives the same equations.
constexpr double kOneLine = 1e-6;

}  // namespace

SolutionSet<WallPose, 2> relpose_3pc_vertical(AcSpan points, const double* weights) {
  int usable = 0;  // two points would do for h1, h3, h7, h9, but exactly, without a check
  double left = 0.0, right = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool counts = weights == nullptr || weights[i] > 0.0;
    if (!counts || !internal::may_lie_on_wall(points[i], WallRows::kPointsOnly)) continue;
    const double x = points[i].x1.x();
    left = usable == 0 ? x : std::min(left, x);
    right = usable == 0 ? x : std::max(right, x);
    ++usable;
  }
  if (usable < 3 || !(right - left > kOneLine)) return {};
  const auto h = internal::wall_homography(points, weights, WallRows::kPointsOnly);
  if (!h) return {};
  return internal::poses_of_wall(*h, points, weights, WallRows::kPointsOnly);
}

}  // namespace oneac
