#include "epipolar_costs.h"

#include "oneac/geometry/essential.h"

#include <Eigen/Geometry>

#include <array>
#include <cstddef>

namespace oneac {
namespace {

using RowVector4 = Eigen::Matrix<double, 1, 4>;

/// ∂R/∂(x, y, z, w) of the polynomial R(q).
std::array<Eigen::Matrix3d, 4> rotation_derivatives(const Eigen::Quaterniond& q) {
  const double x = 2.0 * q.x();
  const double y = 2.0 * q.y();
  const double z = 2.0 * q.z();
  const double w = 2.0 * q.w();
  std::array<Eigen::Matrix3d, 4> d;
  d[0] << 0.0, y, z, y, -2.0 * x, -w, z, w, -2.0 * x;
  d[1] << -2.0 * y, x, w, x, 0.0, z, -w, z, -2.0 * y;
  d[2] << -2.0 * z, -w, x, w, -2.0 * z, y, x, y, 0.0;
  d[3] << 0.0, -z, y, z, 0.0, -x, -y, x, 0.0;
  return d;
}

RowVector4 quaternion_derivative(const Eigen::Matrix3d& dE, const Eigen::Quaterniond& q,
                                 const Eigen::Vector3d& t) {
  const Eigen::Matrix3d dR = cross_matrix(t).transpose() * dE;
  const std::array<Eigen::Matrix3d, 4> columns = rotation_derivatives(q);
  RowVector4 derivative;
  for (int i = 0; i < 4; ++i) {
    derivative(i) = dR.cwiseProduct(columns[static_cast<std::size_t>(i)]).sum();
  }
  return derivative;
}

}  // namespace

template <int N, EpipolarTerm<N> (*Term)(const Eigen::Matrix3d&, const AffineCorrespondence&,
                                         const CorrespondenceNoise&)>
bool EpipolarCost<N, Term>::Evaluate(const double* const* parameters, double* residuals,
                                     double** jacobians) const {
  const Eigen::Quaterniond q = Eigen::Map<const Eigen::Quaterniond>(parameters[0]);
  const RelativePose pose{q.toRotationMatrix(), Eigen::Map<const Eigen::Vector3d>(parameters[1])};
  const EpipolarTerm<N> term = Term(essential_matrix(pose), ac_, noise_);
  if (!term.r.allFinite()) return false;  // rejects the step; Ceres logs residuals that are not
  for (std::ptrdiff_t k = 0; k < N; ++k) {
    residuals[k] = term.r(k);
    if (jacobians == nullptr) continue;
    if (jacobians[0] != nullptr) {
      Eigen::Map<RowVector4> row(&jacobians[0][4 * k]);
      row = quaternion_derivative(term.dE[k], q, pose.t);
    }
    if (jacobians[1] != nullptr) {
      Eigen::Map<Eigen::RowVector3d> row(&jacobians[1][3 * k]);
      row = pose_derivative(term.dE[k], pose).template tail<3>();
    }
  }
  return true;
}

template class EpipolarCost<1, point_term>;
template class EpipolarCost<2, affine_term>;

}  // namespace oneac
