#include "oneac/solvers/relpose_1ac_ground.h"

#include "math/thresholds.h"
#include "planes/planar_plane_system.h"

namespace oneac {
namespace {

static_assert(internal::kGroundHorizon == kHorizon, "the batch form must agree");

using internal::PlaneForm;

struct Ground {
  static constexpr internal::Axis kNormal = internal::Axis::kY;
  static constexpr bool kPointsOnly = false;
  /// The sign is part of it: n·X = d > 0 is the camera height, so y > 0 for every point of the
  /// ground.
  static bool may_show(const AffineCorrespondence& ac) { return ac.x1.y() > kHorizon; }
};

}  // namespace

SolutionSet<PlanarPose, 1> relpose_1ac_ground(const AffineCorrespondence& ac) {
  return relpose_nac_ground(AcSpan(&ac, 1));
}

SolutionSet<PlanarPose, 1> relpose_nac_ground(AcSpan acs, const double* weights) {
  return internal::relpose_known_plane<Ground, PlaneForm::kOptimal>(acs, weights);
}

SolutionSet<PlanarPose, 1> relpose_1ac_ground_rapid(const AffineCorrespondence& ac) {
  return relpose_nac_ground_rapid(AcSpan(&ac, 1));
}

SolutionSet<PlanarPose, 1> relpose_nac_ground_rapid(AcSpan acs, const double* weights) {
  return internal::relpose_known_plane<Ground, PlaneForm::kRapid>(acs, weights);
}

}  // namespace oneac
