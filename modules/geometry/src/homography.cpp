#include "oneac/geometry/homography.h"

#include <Eigen/Dense>

#include <cmath>

namespace oneac {
namespace {

constexpr double kSmallestPivotRatio = 1e-14;  // squares of slopes seen to 1e-7
constexpr double kSmallestDepth = 1e-9;        // a third coordinate below it is "at infinity"

/// Value and derivative of the projective map H at x: A = ∂(Hx)/∂x.
struct LocalMap {
  Eigen::Vector2d image;
  Eigen::Matrix2d derivative;
};

std::optional<LocalMap> local_map(const Eigen::Matrix3d& H, const Eigen::Vector2d& x) {
  const Eigen::Vector3d y = H * x.homogeneous();
  if (!(y.z() > kSmallestDepth)) return std::nullopt;
  LocalMap map;
  map.image = y.head<2>() / y.z();
  map.derivative =
      (H.topLeftCorner<2, 2>() - map.image * H.block<1, 2>(2, 0)) / y.z();  // eq. (5) solved for A
  if (!map.image.allFinite() || !map.derivative.allFinite()) return std::nullopt;
  return map;
}

}  // namespace

Eigen::Matrix3d plane_induced_homography(const RelativePose& T_2_1, const Plane& plane) {
  return T_2_1.R + T_2_1.t * plane.n.transpose() / plane.d;
}

std::optional<AffineCorrespondence> correspondence_from_homography(const Eigen::Matrix3d& H,
                                                                   const Eigen::Vector2d& x1) {
  const auto map = local_map(H, x1);
  if (!map) return std::nullopt;
  return AffineCorrespondence{x1, map->image, map->derivative};
}

Eigen::Matrix<double, 6, 1> homography_residual(const Eigen::Matrix3d& H,
                                                const AffineCorrespondence& ac) {
  const Eigen::Vector3d y = H * ac.x1.homogeneous();
  Eigen::Matrix<double, 6, 1> r;
  r.head<2>() = y.head<2>() - ac.x2 * y.z();  // eq. (4)
  const Eigen::Matrix2d affine =
      H.topLeftCorner<2, 2>() - ac.x2 * H.block<1, 2>(2, 0) - ac.A * y.z();  // eq. (5)
  r.tail<4>() << affine(0, 0), affine(0, 1), affine(1, 0), affine(1, 1);
  return r;
}

std::optional<AffineCorrespondence> rotate_views(const AffineCorrespondence& ac,
                                                 const Eigen::Matrix3d& Q1,
                                                 const Eigen::Matrix3d& Q2) {
  const auto first = local_map(Q1, ac.x1);
  const auto second = local_map(Q2, ac.x2);
  if (!first || !second) return std::nullopt;
  const Eigen::Matrix2d A = second->derivative * ac.A * first->derivative.inverse();
  if (!A.allFinite()) return std::nullopt;
  return AffineCorrespondence{first->image, second->image, A};
}

std::optional<Plane> plane_from_affinity(const RelativePose& T_2_1,
                                         const AffineCorrespondence& ac) {
  // H = R + t mᵀ with m = n/d: the six equations are linear in m.
  const Eigen::Vector3d x1 = ac.x1.homogeneous();
  const Eigen::Vector3d& t = T_2_1.t;
  const Eigen::Vector2d s = t.head<2>() - ac.x2 * t.z();
  Eigen::Matrix<double, 6, 3> M;
  M.topRows<2>() = s * x1.transpose();
  for (int row = 0; row < 2; ++row) {
    for (int col = 0; col < 2; ++col) {
      M.row(2 + 2 * row + col) = -ac.A(row, col) * t.z() * x1.transpose();
      M(2 + 2 * row + col, col) += s(row);
    }
  }
  const Eigen::Matrix<double, 6, 1> rhs = -homography_residual(T_2_1.R, ac);
  const Eigen::Matrix3d normal_matrix = M.transpose() * M;
  const Eigen::LDLT<Eigen::Matrix3d> factor(normal_matrix);
  // Not rcond(): it is 1 for an exactly singular matrix, whose zero pivots LDLT's solve passes
  // over.
  const Eigen::Vector3d pivots = factor.vectorD().cwiseAbs();
  if (!(pivots.minCoeff() > kSmallestPivotRatio * pivots.maxCoeff())) return std::nullopt;
  const Eigen::Vector3d m = factor.solve(M.transpose() * rhs);
  const double length = m.norm();
  if (!(length > 1e-12) || !std::isfinite(length)) return std::nullopt;
  Plane plane{m / length, 1.0 / length};
  if (plane.n.dot(x1) < 0.0) plane = {-plane.n, -plane.d};
  return plane;
}

}  // namespace oneac
