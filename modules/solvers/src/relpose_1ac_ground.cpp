#include "oneac/solvers/relpose_1ac_ground.h"

#include "planar_plane_system.h"
#include "thresholds.h"

namespace oneac {
namespace {

static_assert(internal::kGroundHorizon == kHorizon, "the batch form must agree");

/// The sign is part of it: n·X = d > 0 is the camera height, so y > 0 for every point of the
/// ground.
bool may_lie_on_ground(const AffineCorrespondence& ac) {
  return ac.x1.y() > kHorizon;
}

const internal::KnownPlane kGround{Eigen::Vector3d(0.0, 1.0, 0.0), &may_lie_on_ground};

}  // namespace

SolutionSet<PlanarPose, 1> relpose_1ac_ground(const AffineCorrespondence& ac) {
  return relpose_nac_ground(AcSpan(&ac, 1));
}

SolutionSet<PlanarPose, 1> relpose_nac_ground(AcSpan acs, const double* weights) {
  return internal::relpose_known_plane(kGround, acs, weights, &internal::solve_optimal);
}

SolutionSet<PlanarPose, 1> relpose_1ac_ground_rapid(const AffineCorrespondence& ac) {
  return relpose_nac_ground_rapid(AcSpan(&ac, 1));
}

SolutionSet<PlanarPose, 1> relpose_nac_ground_rapid(AcSpan acs, const double* weights) {
  return internal::relpose_known_plane(kGround, acs, weights, &internal::solve_rapid);
}

}  // namespace oneac
