#include "oneac/solvers/relpose_2pc_ground.h"

#include "planes/planar_plane_system.h"

#include "oneac/solvers/relpose_1ac_ground.h"

namespace oneac {
namespace {

// Two points closer than this [-] are one: their difference has no digits left.
constexpr double kCoincident = 1e-6;

struct GroundPoints {
  static constexpr internal::Axis kNormal = internal::Axis::kY;
  static constexpr bool kPointsOnly = true;
  static bool may_show(const AffineCorrespondence& ac) { return ac.x1.y() > kHorizon; }
};

/// Whether two usable points differ.
[[nodiscard]] bool spread(AcSpan points, const double* weights) {
  const AffineCorrespondence* first = nullptr;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (weights != nullptr && !(weights[i] > 0.0)) continue;
    if (!internal::has_points(points[i]) || !GroundPoints::may_show(points[i])) continue;
    if (first == nullptr) first = &points[i];
    if ((points[i].x1 - first->x1).squaredNorm() > kCoincident * kCoincident) return true;
  }
  return false;
}

}  // namespace

SolutionSet<PlanarPose, 1> relpose_2pc_ground(AcSpan points, const double* weights) {
  if (!spread(points, weights)) return {};
  return internal::relpose_known_plane<GroundPoints, internal::PlaneForm::kOptimal>(points,
                                                                                    weights);
}

}  // namespace oneac
