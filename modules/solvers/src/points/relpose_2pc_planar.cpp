#include "oneac/solvers/relpose_2pc_planar.h"

#include "math/usable.h"
#include "planes/planar_entries.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

// Shares of the input's size below which a vector or a quadratic form is rounding.
constexpr double kRankDeficient = 1e-12;
constexpr double kFlatForm = 1e-10;

using Vector4 = Eigen::Vector4d;

/// The quadratic form e21² + e23² − e12² − e32² as a bilinear one.
[[nodiscard]] double form(const Vector4& a, const Vector4& b) {
  return a(1) * b(1) + a(2) * b(2) - a(0) * b(0) - a(3) * b(3);
}

/// A unit vector orthogonal to up to three orthonormal ones, from the axis farthest from their
/// span.
[[nodiscard]] Vector4 orthogonal_to(const Vector4& a, const Vector4& b, const Vector4& c) {
  const Vector4 inside = a.cwiseAbs2() + b.cwiseAbs2() + c.cwiseAbs2();
  int axis = 0;
  inside.minCoeff(&axis);  // at most 3/4 of the axis lies in the span
  Vector4 v = Vector4::Unit(axis);
  for (int pass = 0; pass < 2; ++pass) {  // twice is enough
    v -= a.dot(v) * a + b.dot(v) * b + c.dot(v) * c;
  }
  return v.normalized();
}

}  // namespace

SolutionSet<PlanarPose, 2> relpose_2pc_planar(AcSpan points) {
  if (points.size() < 2) return {};
  if (!internal::has_points(points[0]) || !internal::has_points(points[1])) return {};
  Vector4 r1 = internal::epipolar_row(points[0]);
  Vector4 r2 = internal::epipolar_row(points[1]);
  const double length1 = r1.norm();
  const double length2 = r2.norm();
  if (!(length1 > kRankDeficient) || !(length2 > kRankDeficient)) return {};
  if (!std::isfinite(length1) || !std::isfinite(length2)) return {};
  r1 /= length1;
  r2 /= length2;
  r2 -= r1.dot(r2) * r1;
  const double rest = r2.norm();
  if (!(rest > 1e-9)) return {};
  r2 /= rest;
  r2 -= r1.dot(r2) * r1;
  r2.normalize();
  const Vector4 n1 = orthogonal_to(r1, r2, Vector4::Zero());
  const Vector4 n2 = orthogonal_to(r1, r2, n1);
  // e = a n1 + b n2: A a² + 2 B a b + C b² = 0.
  const double A = form(n1, n1), B = form(n1, n2), C = form(n2, n2);
  const double size = std::abs(A) + std::abs(B) + std::abs(C);
  if (!(size > kFlatForm)) return {};  // every motion of the pencil fits: the camera only turned
  const double discriminant = B * B - A * C;
  if (discriminant < -kRankDeficient * size * size) return {};
  const double root = std::sqrt(std::max(discriminant, 0.0));
  const double q = B >= 0.0 ? -(B + root) : -(B - root);             // no cancellation
  const Vector4 candidates[2] = {q * n1 + A * n2, C * n1 + q * n2};  // (a : b) = (q : A), (C : q)
  SolutionSet<PlanarPose, 2> poses;
  for (const Vector4& e : candidates) {
    if (!(e.norm() > kRankDeficient * size)) continue;
    const auto pose =
        internal::with_sign(internal::pose_from_entries(e.normalized()), AcSpan(points.begin(), 2),
                            nullptr, internal::EpipolarRows::kPointsOnly);
    if (!pose.empty()) poses.push_back(pose[0]);
  }
  return poses;
}

}  // namespace oneac
