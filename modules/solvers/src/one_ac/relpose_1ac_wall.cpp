#include "oneac/solvers/relpose_1ac_wall.h"

#include "planes/wall_homography.h"

namespace oneac {
namespace {

using internal::WallHomography;
using internal::WallRows;

/// Least squares for h5 = 1 in closed form: in k = x h7 + h9 (the third row of H at x1) the rows of
/// A_vert read a2 k = 0, a3 k + y' h7 = 0, a4 k = 1, y' k = y, and two more that h1 and h3 satisfy
/// exactly.
[[nodiscard]] WallHomography homography_of_one(const AffineCorrespondence& ac) {
  const double x = ac.x1.x(), y = ac.x1.y(), u = ac.x2.x(), v = ac.x2.y();
  const double a1 = ac.A(0, 0), a2 = ac.A(0, 1), a3 = ac.A(1, 0), a4 = ac.A(1, 1);
  const double k = (a4 + v * y) / (a2 * a2 + a4 * a4 + v * v);
  const double h7 = -a3 * k / v;
  const double h1 = u * h7 + a1 * k;
  return {h1, u * k - x * h1, h7, k - x * h7};
}

}  // namespace

SolutionSet<WallPose, 2> relpose_1ac_wall(const AffineCorrespondence& ac) {
  if (!internal::may_lie_on_wall(ac, WallRows::kAffine)) return {};
  return internal::poses_of_wall(homography_of_one(ac), AcSpan(&ac, 1), nullptr, WallRows::kAffine);
}

SolutionSet<WallPose, 2> relpose_nac_wall(AcSpan acs, const double* weights) {
  const std::optional<WallHomography> h =
      internal::wall_homography(acs, weights, WallRows::kAffine);
  if (!h) return {};
  return internal::poses_of_wall(*h, acs, weights, WallRows::kAffine);
}

SolutionSet<WallPose, 4> relpose_1ac_wall_candidates(const AffineCorrespondence& ac) {
  SolutionSet<WallPose, 4> all;
  for (const WallPose& pose : relpose_1ac_wall(ac)) {
    all.push_back(pose);
    all.push_back({{pose.cos_alpha, pose.sin_alpha, -pose.tx, -pose.tz}, -pose.nx, -pose.nz});
  }
  return all;
}

}  // namespace oneac
