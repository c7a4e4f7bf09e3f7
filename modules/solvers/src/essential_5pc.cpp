#include "oneac/solvers/essential_5pc.h"

#include "five_point_cubics.h"
#include "null_space.h"
#include "polynomial.h"
#include "usable.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

// Pivots below this share of the first: fewer than five independent equations.
constexpr double kSingular = 1e-10;
// Cosines of ray angles closer than this are equal: no parallax [-].
constexpr double kSameAngle = 1e-10;
// Roots of a good elimination need one or two steps, those near a double root converge linearly.
constexpr int kPolishSteps = 20;
// Pivots below it cost so many digits that real roots are lost: another of the planes below is
// tried.
constexpr double kGoodPivot = 5e-3;
constexpr double kPolished = 1e-14;  // residual of the cubics for |E| = √2 that is rounding
constexpr double kAccepted = 1e-6;   // residual above which a root was none

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

using Vector9 = Eigen::Matrix<double, 9, 1>;

[[nodiscard]] Vector9 trace_constraint(const Matrix3d& E) {
  const Matrix3d F = E * E.transpose() * E - 0.5 * E.squaredNorm() * E;
  return Eigen::Map<const Vector9>(F.data());
}

/// Gauss-Newton over the four coefficients with |q| = √2 on the nine trace constraints; the
/// determinant's follows from them where E is not zero. Returns the residual.
[[nodiscard]] double polish(const Basis& basis, Eigen::Vector4d& q) {
  double residual = 0.0;
  for (int step = 0;; ++step) {
    q *= std::sqrt(2.0) / q.norm();
    const Matrix3d E = unpack(basis * q);
    const Vector9 F = trace_constraint(E);
    residual = F.norm();
    if (!(residual > kPolished) || step == kPolishSteps) return residual;
    const Matrix3d EEt = E * E.transpose();
    const Matrix3d EtE = E.transpose() * E;
    const double half = 0.5 * E.squaredNorm();
    Eigen::Matrix<double, 9, 4> J;
    for (int k = 0; k < 4; ++k) {
      const Matrix3d D = unpack(basis.col(k));
      const Matrix3d dF =
          D * EtE + E * D.transpose() * E + EEt * D - half * D - E.cwiseProduct(D).sum() * E;
      J.col(k) = Eigen::Map<const Vector9>(dF.data());
    }
    Eigen::Matrix4d N = J.transpose() * J;
    N += q * q.transpose();
    q -= N.ldlt().solve(J.transpose() * F);
    if (!q.allFinite()) return 1.0;
  }
}

// Planes without structure to reflect the basis at, unit normals.
constexpr int kPlanes = 4;
constexpr double kPlane[kPlanes][4] = {{0.36, -0.48, 0.64, 0.48},
                                       {0.5, 0.5, 0.5, 0.5},
                                       {0.64, -0.48, -0.36, 0.48},
                                       {0.1, 0.7, -0.1, -0.7}};

/// Elimination leaves each vector of the null space with an entry of E to itself, and planar motion
/// has entries that vanish: the coefficient of W would be zero and x, y, z infinite.
[[nodiscard]] Basis reflected(const Basis& basis, const double (&normal)[4]) {
  const Eigen::Vector4d v = Eigen::Map<const Eigen::Vector4d>(normal);
  const Vector9 along = basis * v;
  return basis - 2.0 * along * v.transpose();
}

/// Nistér's rows for the first plane that determines them well, else for the best; false when the
/// cubics are dependent.
[[nodiscard]] bool well_posed_rows(Basis& basis, PolynomialRow (&B)[3]) {
  const Basis plain = basis;
  double best = 0.0;
  for (int k = 0; k < kPlanes && best < kGoodPivot; ++k) {
    const Basis mixed = reflected(plain, kPlane[k]);
    PolynomialRow rows[3];
    const double pivot = internal::five_point_rows(mixed, rows);
    if (!(pivot > 0.0)) return false;
    if (pivot <= best) continue;
    best = pivot;
    basis = mixed;
    std::copy(rows, rows + 3, B);
  }
  return true;
}

/// Whether all angles between rays are the same in both views: the camera only turned, and every t
/// fits.
[[nodiscard]] bool is_pure_rotation(AcSpan points) {
  Eigen::Vector3d r1[5], r2[5];
  for (std::size_t i = 0; i < 5; ++i) {
    r1[i] = points[i].x1.homogeneous().normalized();
    r2[i] = points[i].x2.homogeneous().normalized();
  }
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
  if (is_pure_rotation(points)) return solutions;
  Basis basis;
  if (!internal::null_space<5, 9>(rows, kSingular, basis)) return solutions;
  PolynomialRow B[3];
  if (!well_posed_rows(basis, B)) return solutions;
  double d[11];
  internal::determinant(B, d);
  const internal::RealRoots<10> roots(d);
  for (int i = 0; i < roots.size(); ++i) {
    const double z = roots[i];
    const Eigen::Vector3d n = null_vector(B, z);
    Eigen::Vector4d q(n.x(), n.y(), z * n.z(), n.z());
    if (!(q.norm() > 0.0) || !q.allFinite()) continue;
    if (polish(basis, q) < kAccepted) solutions.push_back(unpack(basis * q));
  }
  return solutions;
}

}  // namespace oneac
