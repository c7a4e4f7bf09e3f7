#include "oneac/geometry/essential.h"

#include <Eigen/Dense>

#include <cmath>
#include <stdexcept>

namespace oneac {

Eigen::Matrix3d essential_matrix(const RelativePose& T_2_1) {
  return cross_matrix(T_2_1.t) * T_2_1.R;
}

std::array<RelativePose, 4> decompose_essential(const Eigen::Matrix3d& E) {
  // The SVD leaves its factors uninitialised for such input.
  if (!E.allFinite()) throw std::invalid_argument("decompose_essential: E must be finite");
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(E, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  Eigen::Matrix3d V = svd.matrixV();
  if (U.determinant() < 0.0) U.col(2) = -U.col(2);
  if (V.determinant() < 0.0) V.col(2) = -V.col(2);
  Eigen::Matrix3d W;
  W << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  const Eigen::Matrix3d Ra = U * W * V.transpose();
  const Eigen::Matrix3d Rb = U * W.transpose() * V.transpose();
  const Eigen::Vector3d t = U.col(2);
  return {RelativePose{Ra, t}, RelativePose{Ra, -t}, RelativePose{Rb, t}, RelativePose{Rb, -t}};
}

double sampson_distance(const Eigen::Matrix3d& E, const Eigen::Vector2d& x1,
                        const Eigen::Vector2d& x2) {
  const Eigen::Vector3d Ex1 = E * x1.homogeneous();
  const Eigen::Vector2d Etx2 =
      E.topLeftCorner<2, 2>().transpose() * x2 + E.block<1, 2>(2, 0).transpose();
  const double squared_gradient = Ex1.head<2>().squaredNorm() + Etx2.squaredNorm();
  if (!(squared_gradient > 0.0)) return 0.0;
  return x2.homogeneous().dot(Ex1) / std::sqrt(squared_gradient);
}

Eigen::Vector2d affine_epipolar_residual(const Eigen::Matrix3d& E, const AffineCorrespondence& ac) {
  const Eigen::Vector3d Ex1 = E * ac.x1.homogeneous();
  const Eigen::Vector3d Etx2 = E.transpose() * ac.x2.homogeneous();
  return ac.A.transpose() * Ex1.head<2>() + Etx2.head<2>();
}

}  // namespace oneac
