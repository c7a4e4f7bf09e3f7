#include "points/five_point_roots.h"

#include "math/polynomial.h"

#include <Eigen/Dense>

#include <cmath>

namespace oneac::internal {
namespace {

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

[[nodiscard]] Eigen::Matrix3d unpack(const Eigen::Matrix<double, 9, 1>& e) {
  Eigen::Matrix3d E;
  E << e(0), e(1), e(2), e(3), e(4), e(5), e(6), e(7), e(8);
  return E;
}

}  // namespace

SolutionSet<Eigen::Matrix3d, 10> essentials_of(const Basis& basis) {
  SolutionSet<Eigen::Matrix3d, 10> found;
  PolynomialRow B[3];
  if (!five_point_rows(basis, B)) return found;
  double d[11];
  determinant(B, d);
  const RealRoots<10> roots(d);
  for (int i = 0; i < roots.size(); ++i) {
    const double z = roots[i];
    const Eigen::Vector3d n = null_vector(B, z);
    const Eigen::Vector4d q(n.x(), n.y(), z * n.z(), n.z());
    if (!(q.norm() > 0.0) || !q.allFinite()) continue;
    found.push_back(unpack(basis * q.normalized()));
  }
  return found;
}

}  // namespace oneac::internal
