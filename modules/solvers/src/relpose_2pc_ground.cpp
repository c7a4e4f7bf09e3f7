#include "oneac/solvers/relpose_2pc_ground.h"

#include "planar_plane_system.h"

#include "oneac/solvers/relpose_1ac_ground.h"

namespace oneac {
namespace {

// Two points closer than this [-] are one: their difference has no digits left.
constexpr double kCoincident = 1e-6;

bool under_horizon(const AffineCorrespondence& ac) {
  return ac.x1.y() > kHorizon;
}

const internal::KnownPlane kGround{Eigen::Vector3d(0.0, 1.0, 0.0), &under_horizon, true};

/// Whether two usable points differ.
[[nodiscard]] bool spread(AcSpan points, const double* weights) {
  const AffineCorrespondence* first = nullptr;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (weights != nullptr && !(weights[i] > 0.0)) continue;
    if (!internal::has_points(points[i]) || !under_horizon(points[i])) continue;
    if (first == nullptr) first = &points[i];
    if ((points[i].x1 - first->x1).squaredNorm() > kCoincident * kCoincident) return true;
  }
  return false;
}

}  // namespace

SolutionSet<PlanarPose, 1> relpose_2pc_ground(AcSpan points, const double* weights) {
  if (!spread(points, weights)) return {};
  return internal::relpose_known_plane(kGround, points, weights, &internal::solve_optimal);
}

}  // namespace oneac
