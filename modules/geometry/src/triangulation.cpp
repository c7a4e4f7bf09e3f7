#include "oneac/geometry/triangulation.h"

#include <Eigen/Dense>

#include <cmath>

namespace oneac {
namespace {

/// Depths along the two rays at their closest approach, times the squared sine of the parallax.
struct ScaledDepths {
  double z1;
  double z2;
  double squared_sine;  // of the angle between the rays, times the squared ray lengths
};

/// Minimises |z1 a − z2 b + t|² with a = R x1, b = x2 (both with third coordinate 1 before R).
ScaledDepths closest_approach(const RelativePose& T_2_1, const Eigen::Vector2d& x1,
                              const Eigen::Vector2d& x2) {
  const Eigen::Vector3d a = T_2_1.R * x1.homogeneous();
  const Eigen::Vector3d b = x2.homogeneous();
  const double aa = a.squaredNorm();
  const double bb = b.squaredNorm();
  const double ab = a.dot(b);
  const double at = a.dot(T_2_1.t);
  const double bt = b.dot(T_2_1.t);
  return {ab * bt - bb * at, aa * bt - ab * at, a.cross(b).squaredNorm()};
}

}  // namespace

std::optional<TriangulatedPoint> triangulate(const RelativePose& T_2_1, const Eigen::Vector2d& x1,
                                             const Eigen::Vector2d& x2, double min_parallax) {
  const ScaledDepths depths = closest_approach(T_2_1, x1, x2);
  const double squared_lengths = x1.homogeneous().squaredNorm() * x2.homogeneous().squaredNorm();
  if (!(depths.squared_sine > min_parallax * min_parallax * squared_lengths)) return std::nullopt;
  TriangulatedPoint point;
  point.z1 = depths.z1 / depths.squared_sine;
  point.z2 = depths.z2 / depths.squared_sine;
  const Eigen::Vector3d from_first = point.z1 * x1.homogeneous();
  const Eigen::Vector3d from_second = T_2_1.R.transpose() * (point.z2 * x2.homogeneous() - T_2_1.t);
  point.X1 = 0.5 * (from_first + from_second);
  if (!point.X1.allFinite()) return std::nullopt;
  return point;
}

int cheirality(const RelativePose& T_2_1, const Eigen::Vector2d& x1, const Eigen::Vector2d& x2) {
  const ScaledDepths depths = closest_approach(T_2_1, x1, x2);
  if (!(depths.squared_sine > 0.0)) return 0;
  if (depths.z1 > 0.0 && depths.z2 > 0.0) return 1;
  if (depths.z1 < 0.0 && depths.z2 < 0.0) return -1;
  return 0;
}

}  // namespace oneac
