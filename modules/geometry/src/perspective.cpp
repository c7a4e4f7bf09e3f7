#include "oneac/geometry/perspective.h"

#include "oneac/geometry/triangulation.h"

#include <Eigen/Geometry>

namespace oneac {
namespace {

// 1σ of g over ρ before an affinity speaks: an inverse depth that changes by its own size over a
// tenth of the focal length, a surface seen at 6°.
constexpr double kSteepest = 10.0;

}  // namespace

std::optional<Eigen::Vector2d> perspective_of(const AffineCorrespondence& ac,
                                              const RelativePose& T_2_1, double affine_sigma) {
  const auto point = triangulate(T_2_1, ac.x1, ac.x2);
  if (!point || !point->in_front()) return std::nullopt;
  const double rho = 1.0 / point->z1;
  const Eigen::Vector3d y = T_2_1.R * ac.x1.homogeneous() + rho * T_2_1.t;
  if (!(y.z() > 0.0)) return std::nullopt;
  Eigen::Matrix<double, 2, 3> D;  // Dπ(y)
  D << 1.0, 0.0, -y.x() / y.z(), 0.0, 1.0, -y.y() / y.z();
  D /= y.z();
  const Eigen::Matrix2d rest = ac.A - D * T_2_1.R.leftCols<2>();  // a gᵀ
  const Eigen::Vector2d a = D * T_2_1.t;
  const double off = affine_sigma / (kSteepest * rho);
  const Eigen::Vector2d g = rest.transpose() * a / (a.squaredNorm() + off * off);
  const Eigen::Vector2d eta = (T_2_1.R.row(2).head<2>().transpose() + T_2_1.t.z() * g) / y.z();
  if (!eta.allFinite()) return std::nullopt;
  return eta;
}

}  // namespace oneac
