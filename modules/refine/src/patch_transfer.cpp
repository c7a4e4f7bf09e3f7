#include "patch_transfer.h"

#include <Eigen/Geometry>

namespace oneac {

PatchTransfer::PatchTransfer(const RelativePose& anchor, const RelativePose& view,
                             const WindowLandmark& patch)
    : R_view_anchor(view.R * anchor.R.transpose()),
      t_view_anchor(view.t - R_view_anchor * anchor.t),
      t_anchor_(anchor.t),
      t_view_(view.t),
      ray_(patch.x.homogeneous()),
      rho_(patch.inverse_depth),
      gradient_(patch.gradient) {
  y = R_view_anchor * ray_ + rho_ * t_view_anchor;
  B = R_view_anchor.leftCols<2>() + t_view_anchor * gradient_.transpose();
}

Eigen::Matrix<double, 2, 3> PatchTransfer::projection() const {
  Eigen::Matrix<double, 2, 3> D;
  D << 1.0, 0.0, -y.x() / y.z(), 0.0, 1.0, -y.y() / y.z();
  return D / y.z();
}

Eigen::Matrix2d PatchTransfer::affinity() const {
  return projection() * B;
}

Matrix36 PatchTransfer::anchor_column(const Eigen::Vector3d& c, double s) const {
  Matrix36 d;
  d.leftCols<3>() = R_view_anchor * cross_matrix(c - s * t_anchor_);
  d.rightCols<3>() = -s * R_view_anchor;
  return d;
}

Matrix36 PatchTransfer::view_column(const Eigen::Vector3d& F, double s) const {
  Matrix36 d;
  d.leftCols<3>() = -cross_matrix(F - s * t_view_);
  d.rightCols<3>() = s * Eigen::Matrix3d::Identity();
  return d;
}

PatchTransfer::PointDerivative PatchTransfer::point_derivative() const {
  const Eigen::Matrix<double, 2, 3> D = projection();
  Eigen::Matrix3d dy;
  dy << R_view_anchor.leftCols<2>(), t_view_anchor;
  return {D * anchor_column(ray_, rho_), D * view_column(y, rho_), D * dy};
}

namespace {

/// dA of one column j: A_j = Dπ(y) b, from dy and db.
template <int N>
Eigen::Matrix<double, 2, N> affinity_column(const Eigen::Vector3d& y, const Eigen::Vector3d& b,
                                            const Eigen::Matrix<double, 2, 3>& D,
                                            const Eigen::Matrix<double, 3, N>& dy,
                                            const Eigen::Matrix<double, 3, N>& db) {
  // A_j = (b₁₂ − u b₃) / y₃ with u = y₁₂ / y₃.
  const Eigen::Vector2d a = D * b;
  const Eigen::Matrix<double, 2, N> du = D * dy;
  return D * db - (a * dy.row(2) + b.z() * du) / y.z();
}

}  // namespace

PatchTransfer::AffineDerivative PatchTransfer::affine_derivative() const {
  const Eigen::Matrix<double, 2, 3> D = projection();
  Matrix35 dy_patch = Matrix35::Zero();
  dy_patch.leftCols<2>() = R_view_anchor.leftCols<2>();
  dy_patch.col(2) = t_view_anchor;
  const Matrix36 dy_anchor = anchor_column(ray_, rho_);
  const Matrix36 dy_view = view_column(y, rho_);
  AffineDerivative d;
  for (Eigen::Index j = 0; j < 2; ++j) {
    const Eigen::Vector3d e = Eigen::Vector3d::Unit(j);
    const Eigen::Vector3d b = B.col(j);
    Matrix35 db_patch = Matrix35::Zero();
    db_patch.col(3 + j) = t_view_anchor;
    d.anchor.middleRows<2>(2 * j) =
        affinity_column<6>(y, b, D, dy_anchor, anchor_column(e, gradient_(j)));
    d.view.middleRows<2>(2 * j) =
        affinity_column<6>(y, b, D, dy_view, view_column(b, gradient_(j)));
    d.patch.middleRows<2>(2 * j) = affinity_column<5>(y, b, D, dy_patch, db_patch);
  }
  return d;
}

}  // namespace oneac
