#pragma once

#include "math/thresholds.h"
#include "math/usable.h"
#include "planes/plane_gram.h"
#include "planes/plane_solve.h"

#include "oneac/solvers/planar_pose.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"
#include "oneac/solvers/wall_pose.h"

#include <cmath>

namespace oneac::internal {

/// How the two forms of a solver differ.
enum class PlaneForm { kOptimal, kRapid };

/// The correspondences of a plane put together.
struct PlaneSum {
  PlaneGram gram;
  const AffineCorrespondence* first = nullptr;  ///< usable one
  int side = 0;  ///< votes for the sign of d: before the camera n·x̃1 has the sign of d
};

/// A Plane as one solver sees it has kNormal, kPointsOnly (leave the affinities out) and
/// may_show(ac): whether the point can lie on it usefully.
template <class Plane>
[[nodiscard]] PlaneSum sum_over_plane(AcSpan acs, const double* weights) {
  PlaneSum sum;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    const double weight = weights == nullptr ? 1.0 : weights[i];
    const bool usable = Plane::kPointsOnly ? has_points(acs[i]) : is_usable(acs[i]);
    if (!(weight > 0.0) || !usable || !Plane::may_show(acs[i])) continue;
    if constexpr (Plane::kPointsOnly) {
      sum.gram.template add_points<Plane::kNormal>(acs[i], weight);
    } else {
      sum.gram.template add<Plane::kNormal>(acs[i], weight);
    }
    sum.side += along_normal<Plane::kNormal>(acs[i]) > 0.0 ? 1 : -1;
    if (sum.first == nullptr) sum.first = &acs[i];
  }
  return sum;
}

/// The whole solver: correspondences on the plane to (c, s, t_x/|d|, t_z/|d|) and the sign of d,
/// zero when there is none: none is usable, no motion, or the plane behind the second camera.
template <class Plane, PlaneForm kForm>
[[nodiscard]] double solve_known_plane(AcSpan acs, const double* weights, PlaneSolution& x) {
  const PlaneSum sum = sum_over_plane<Plane>(acs, weights);
  if (sum.first == nullptr) return 0.0;
  const bool solved =
      kForm == PlaneForm::kOptimal ? solve_optimal(sum.gram, x) : solve_rapid(sum.gram, x);
  if (!solved) return 0.0;
  // Numbers whose squares leave the range of doubles end off the circle: no rotation.
  constexpr double kOffCircle = 1e-9;
  if (!(std::abs(x.c * x.c + x.s * x.s - 1.0) < kOffCircle)) return 0.0;
  const double squared_length = x.p * x.p + x.q * x.q;
  if (!(squared_length > kNoPlaneMotion * kNoPlaneMotion) || !std::isfinite(squared_length)) {
    return 0.0;
  }
  // Third row of H: the plane must stay before the second camera.
  const double z2 = x.s * sum.first->x1.x() + x.q * along_normal<Plane::kNormal>(*sum.first) + x.c;
  if (!(z2 > 0.0) || !std::isfinite(z2)) return 0.0;
  const double sign = sum.side >= 0 ? 1.0 : -1.0;
  x.p *= sign;
  x.q *= sign;
  return sign;
}

/// Correspondences on the plane to the pose with t in units of |d|.
template <class Plane, PlaneForm kForm>
[[nodiscard]] SolutionSet<PlanarPose, 1> relpose_known_plane(AcSpan acs, const double* weights) {
  PlaneSolution x{};
  if (solve_known_plane<Plane, kForm>(acs, weights, x) == 0.0) return {};
  return PlanarPose{x.c, x.s, x.p, x.q};
}

/// The same for a vertical plane: the normal, turned towards the wall, comes with the pose.
template <class Plane, PlaneForm kForm>
[[nodiscard]] SolutionSet<WallPose, 1> relpose_known_wall(AcSpan acs, const double* weights) {
  PlaneSolution x{};
  const double sign = solve_known_plane<Plane, kForm>(acs, weights, x);
  if (sign == 0.0) return {};
  const bool side_wall = Plane::kNormal == Axis::kX;
  return WallPose{{x.c, x.s, x.p, x.q}, side_wall ? sign : 0.0, side_wall ? 0.0 : sign};
}

}  // namespace oneac::internal
