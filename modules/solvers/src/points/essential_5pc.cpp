#include "oneac/solvers/essential_5pc.h"

#include "math/null_space.h"
#include "math/polynomial.h"
#include "math/usable.h"
#include "points/five_point_basis.h"
#include "points/five_point_cubics.h"
#include "points/five_point_polish.h"
#include "points/five_rays.h"

#include "oneac/geometry/essential.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

// Pivots below this share of the first: fewer than five independent equations.
constexpr double kSingular = 1e-10;
// Cosines of ray angles closer than this are equal: no parallax [-].
constexpr double kSameAngle = 1e-10;

using Eigen::Matrix3d;
using internal::Basis;
using internal::PolynomialRow;

template <int N>
[[nodiscard]] double value(const double (&c)[N], double z) {
  double v = c[N - 1];
  for (int i = N - 2; i >= 0; --i) v = v * z + c[i];
  return v;
}

/// Null vector (x, y, 1) of B(z) from the pair of rows that determines it best.
[[nodiscard]] Eigen::Vector3d null_vector(const PolynomialRow (&B)[3], double z) {
  Eigen::Vector3d row[3];
  for (int i = 0; i < 3; ++i) row[i] = {value(B[i].x, z), value(B[i].y, z), value(B[i].one, z)};
  Eigen::Vector3d best = row[0].cross(row[1]);
  for (int i = 1; i < 3; ++i) {
    const Eigen::Vector3d other = row[i].cross(row[(i + 1) % 3]);
    if (std::abs(other.z()) > std::abs(best.z())) best = other;
  }
  return best;
}

[[nodiscard]] Matrix3d unpack(const Eigen::Matrix<double, 9, 1>& e) {
  Matrix3d E;
  E << e(0), e(1), e(2), e(3), e(4), e(5), e(6), e(7), e(8);
  return E;
}

/// Whether all angles between rays are the same in both views: the camera only turned, and every t
/// fits.
[[nodiscard]] bool is_pure_rotation(const internal::FiveRays& rays) {
  const auto& [r1, r2] = rays;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < i; ++j) {
      if (std::abs(r1[i].dot(r1[j]) - r2[i].dot(r2[j])) > kSameAngle) return false;
    }
  }
  return true;
}

}  // namespace

SolutionSet<Matrix3d, 10> essential_5pc(AcSpan points) {
  SolutionSet<Matrix3d, 10> solutions;
  if (points.size() < 5) return solutions;
  Eigen::Matrix<double, 5, 9> rows;
  for (std::size_t i = 0; i < 5; ++i) {
    if (!internal::has_points(points[i])) return solutions;
    const double x = points[i].x1.x(), y = points[i].x1.y();
    const double u = points[i].x2.x(), v = points[i].x2.y();
    rows.row(static_cast<Eigen::Index>(i)) << u * x, u * y, u, v * x, v * y, v, x, y, 1.0;
  }
  const internal::FiveRays rays(points);
  if (is_pure_rotation(rays)) return solutions;
  Basis basis;
  if (!internal::null_space<5, 9>(rows, kSingular, basis)) return solutions;
  basis = internal::well_scaled(basis, rays);
  PolynomialRow B[3];
  if (!internal::five_point_rows(basis, B)) return solutions;
  double d[11];
  internal::determinant(B, d);
  const internal::RealRoots<10> roots(d);
  for (int i = 0; i < roots.size(); ++i) {
    const double z = roots[i];
    const Eigen::Vector3d n = null_vector(B, z);
    Eigen::Vector4d q(n.x(), n.y(), z * n.z(), n.z());
    if (!(q.norm() > 0.0) || !q.allFinite()) continue;
    RelativePose T = internal::motion_near(unpack(basis * q.normalized()));
    if (internal::polish_on_five_points(points, T)) solutions.push_back(essential_matrix(T));
  }
  return solutions;
}

}  // namespace oneac
