#include "oneac/solvers/relpose_1ac_front_wall.h"

#include "planes/planar_plane_system.h"

#include "oneac/solvers/relpose_1ac_ground.h"

#include <cmath>

namespace oneac {
namespace {

using internal::PlaneForm;

struct Wall {
  static constexpr internal::Axis kNormal = internal::Axis::kZ;
  static constexpr bool kPointsOnly = false;
  /// On y = 0 only three of the six equations are left, for which there are two solutions.
  static bool may_show(const AffineCorrespondence& ac) { return std::abs(ac.x1.y()) > kHorizon; }
};

}  // namespace

SolutionSet<WallPose, 1> relpose_1ac_front_wall(const AffineCorrespondence& ac) {
  return relpose_nac_front_wall(AcSpan(&ac, 1));
}

SolutionSet<WallPose, 1> relpose_nac_front_wall(AcSpan acs, const double* weights) {
  return internal::relpose_known_wall<Wall, PlaneForm::kOptimal>(acs, weights);
}

SolutionSet<WallPose, 1> relpose_1ac_front_wall_rapid(const AffineCorrespondence& ac) {
  return relpose_nac_front_wall_rapid(AcSpan(&ac, 1));
}

SolutionSet<WallPose, 1> relpose_nac_front_wall_rapid(AcSpan acs, const double* weights) {
  return internal::relpose_known_wall<Wall, PlaneForm::kRapid>(acs, weights);
}

}  // namespace oneac
