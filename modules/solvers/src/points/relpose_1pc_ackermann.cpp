#include "oneac/solvers/relpose_1pc_ackermann.h"

#include "math/usable.h"
#include "planes/planar_entries.h"

#include <cmath>

namespace oneac {
namespace {

// Rows shorter than this [-] say nothing: both points on the horizon.
constexpr double kEmptyRow = 1e-12;
// Change of a point's elevation [-], relative, that is rounding.
constexpr double kSameElevation = 1e-12;

/// A camera that stands, or turns on the spot, leaves a point's elevation, y² / (1 + x²), as it is.
/// So does one on a circle whose chord lies square to the ray: outside the view of a camera that
/// looks ahead.
[[nodiscard]] bool changes_elevation(const Eigen::Vector2d& x1, const Eigen::Vector2d& x2) {
  const double before = x1.y() * x1.y() * (1.0 + x2.x() * x2.x());
  const double after = x2.y() * x2.y() * (1.0 + x1.x() * x1.x());
  return std::abs(after - before) > kSameElevation * (before + after);
}

}  // namespace

SolutionSet<PlanarPose, 1> relpose_1pc_ackermann(AcSpan points, const double* weights) {
  // E12 = cos h, E21 = −cos h, E23 = E32 = sin h with h = α/2: rows a cos h + b sin h = 0.
  double aa = 0.0, ab = 0.0, bb = 0.0;
  bool moved = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double weight = weights == nullptr ? 1.0 : weights[i];
    if (!(weight > 0.0) || !internal::has_points(points[i])) continue;
    moved = moved || changes_elevation(points[i].x1, points[i].x2);
    const Eigen::Vector4d row = internal::epipolar_row(points[i]);
    const double a = row(0) - row(1);
    const double b = row(2) + row(3);
    aa += weight * a * a;
    ab += weight * a * b;
    bb += weight * b * b;
  }
  if (!moved) return {};
  const double half = 0.5 * (aa - bb);
  const double radius = std::sqrt(half * half + ab * ab);
  if (!(radius > kEmptyRow * kEmptyRow) || !std::isfinite(radius)) return {};
  // Eigenvector of the smaller eigenvalue: (cos h, sin h), turned so that |h| < π/2.
  double c = half > 0.0 ? -ab : radius - half;
  double s = half > 0.0 ? radius + half : -ab;
  const double scale = (c < 0.0 ? -1.0 : 1.0) / std::sqrt(c * c + s * s);
  c *= scale;
  s *= scale;
  const PlanarPose pose{c * c - s * s, 2.0 * s * c, s, -c};
  return internal::with_sign(pose, points, weights, internal::EpipolarRows::kPointsOnly);
}

}  // namespace oneac
