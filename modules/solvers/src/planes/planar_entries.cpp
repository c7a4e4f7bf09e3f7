#include "planes/planar_entries.h"

#include "math/usable.h"

#include "oneac/geometry/triangulation.h"

#include <cmath>

namespace oneac::internal {
namespace {

[[nodiscard]] PlanarPose flipped(const PlanarPose& pose) {
  return {pose.cos_alpha, pose.sin_alpha, -pose.tx, -pose.tz};
}

}  // namespace

std::optional<PlanarPose> pose_from_entries(const Eigen::Vector4d& e) {
  const double squared = e(0) * e(0) + e(3) * e(3);
  if (!(squared > 1e-24 * e.squaredNorm())) return std::nullopt;
  const double length = std::sqrt(squared);
  const double tx = e(3) / length;
  const double tz = -e(0) / length;
  const double c = tz * e(1) - tx * e(2);
  const double s = -tx * e(1) - tz * e(2);
  const double norm = std::hypot(c, s);
  if (!(norm > 1e-12 * length) || !std::isfinite(norm)) return std::nullopt;
  return PlanarPose{c / norm, s / norm, tx, tz};
}

SolutionSet<PlanarPose, 1> with_sign(const std::optional<PlanarPose>& pose, AcSpan acs,
                                     const double* weights, EpipolarRows rows) {
  if (!pose) return {};
  int votes = 0;
  int voters = 0;
  const RelativePose T = pose->pose();
  for (std::size_t i = 0; i < acs.size(); ++i) {
    const bool usable = rows == EpipolarRows::kAffine ? is_usable(acs[i]) : has_points(acs[i]);
    if (!usable || (weights != nullptr && !(weights[i] > 0.0))) continue;
    const int vote = cheirality(T, acs[i].x1, acs[i].x2);
    votes += vote;
    voters += std::abs(vote);
  }
  if (voters == 0) return {};
  return votes >= 0 ? *pose : flipped(*pose);
}

}  // namespace oneac::internal
