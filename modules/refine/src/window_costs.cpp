#include "window_costs.h"

#include "patch_transfer.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

template <int Rows>
using RowMajor7 = Eigen::Matrix<double, Rows, 7, Eigen::RowMajor>;

/// Writes ∂r/∂(w, v) into the first six columns of a pose's Jacobian, if it is wanted.
template <int Rows>
void store_pose_jacobian(const Eigen::Matrix<double, Rows, 6>& d, double* jacobian) {
  if (jacobian == nullptr) return;
  Eigen::Map<RowMajor7<Rows>> out(jacobian);
  out.template leftCols<6>() = d;
  out.col(6).setZero();
}

WindowLandmark load_landmark(const double* block, int size) {
  WindowLandmark landmark;
  landmark.x << block[0], block[1];
  landmark.inverse_depth = block[2];
  if (size == 5) landmark.gradient << block[3], block[4];
  return landmark;
}

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

}  // namespace

void store_pose(const RelativePose& pose, double* block) {
  const Eigen::Quaterniond q(pose.R);
  std::copy_n(q.coeffs().data(), 4, block);
  std::copy_n(pose.t.data(), 3, block + 4);
}

RelativePose load_pose(const double* block) {
  const Eigen::Quaterniond q(block[3], block[0], block[1], block[2]);
  return {q.normalized().toRotationMatrix(), {block[4], block[5], block[6]}};
}

bool PoseManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  RelativePose pose = load_pose(x);
  pose.R = rotation_from_vector({delta[0], delta[1], delta[2]}) * pose.R;
  pose.t += Eigen::Vector3d(delta[3], delta[4], delta[5]);
  store_pose(pose, x_plus_delta);
  return true;
}

bool PoseManifold::PlusJacobian(const double*, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> J(jacobian);
  J.setZero();
  J.topRows<6>().setIdentity();
  return true;
}

bool PoseManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  const RelativePose a = load_pose(y);
  const RelativePose b = load_pose(x);
  const Eigen::Vector3d w = rotation_vector(a.R * b.R.transpose());
  const Eigen::Vector3d v = a.t - b.t;
  std::copy_n(w.data(), 3, y_minus_x);
  std::copy_n(v.data(), 3, y_minus_x + 3);
  return true;
}

bool PoseManifold::MinusJacobian(const double*, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> J(jacobian);
  J.setZero();
  J.leftCols<6>().setIdentity();
  return true;
}

template <int LandmarkSize>
bool ReprojectionCost<LandmarkSize>::Evaluate(double const* const* blocks, double* residuals,
                                              double** jacobians) const {
  const PatchTransfer transfer(load_pose(blocks[0]), load_pose(blocks[1]),
                               load_landmark(blocks[2], LandmarkSize));
  if (!transfer.in_front()) return false;
  const Eigen::Vector2d x = transfer.point();
  residuals[0] = (x.x() - u_) / sigma_;
  residuals[1] = (x.y() - v_) / sigma_;
  if (!std::isfinite(residuals[0]) || !std::isfinite(residuals[1])) return false;
  if (jacobians == nullptr) return true;
  const auto d = transfer.point_derivative();
  store_pose_jacobian<2>(d.anchor / sigma_, jacobians[0]);
  store_pose_jacobian<2>(d.view / sigma_, jacobians[1]);
  if (jacobians[2] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 2, LandmarkSize, Eigen::RowMajor>> J(jacobians[2]);
    J.setZero();
    J.template leftCols<3>() = d.patch / sigma_;
  }
  return true;
}

AffinityCost::AffinityCost(const Eigen::Matrix2d& A, double sigma) : sigma_(sigma) {
  std::copy_n(A.data(), 4, a_);
}

bool AffinityCost::Evaluate(double const* const* blocks, double* residuals,
                            double** jacobians) const {
  const PatchTransfer transfer(load_pose(blocks[0]), load_pose(blocks[1]),
                               load_landmark(blocks[2], 5));
  if (!transfer.in_front()) return false;
  const Eigen::Matrix2d A = transfer.affinity();
  for (int i = 0; i < 4; ++i) residuals[i] = (A.data()[i] - a_[i]) / sigma_;
  if (!A.allFinite()) return false;
  if (jacobians == nullptr) return true;
  const auto d = transfer.affine_derivative();
  store_pose_jacobian<4>(d.anchor / sigma_, jacobians[0]);
  store_pose_jacobian<4>(d.view / sigma_, jacobians[1]);
  if (jacobians[2] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 4, 5, Eigen::RowMajor>> J(jacobians[2]);
    J = d.patch / sigma_;
  }
  return true;
}

template <int LandmarkSize>
bool AnchorCost<LandmarkSize>::Evaluate(double const* const* blocks, double* residuals,
                                        double** jacobians) const {
  residuals[0] = (blocks[0][0] - u_) / sigma_;
  residuals[1] = (blocks[0][1] - v_) / sigma_;
  if (jacobians == nullptr || jacobians[0] == nullptr) return true;
  Eigen::Map<Eigen::Matrix<double, 2, LandmarkSize, Eigen::RowMajor>> J(jacobians[0]);
  J.setZero();
  J(0, 0) = J(1, 1) = 1.0 / sigma_;
  return true;
}

Eigen::Vector3d planar_residuals(const PlanarPrior& prior, const RelativePose& first,
                                 const RelativePose& second) {
  using Vector3 = Eigen::Map<const Eigen::Vector3d>;
  const Vector3 down(prior.down), right(prior.right), ahead(prior.ahead);
  // Where the second camera is, seen by the first; and the first's gravity seen by the second.
  const Eigen::Vector3d centre = -(second.R.transpose() * second.t);
  const Eigen::Vector3d gravity = second.R * (first.R.transpose() * down);
  return {down.dot(first.R * centre + first.t) / prior.sigma_travel,
          ahead.dot(gravity) / prior.sigma_rotation, right.dot(gravity) / prior.sigma_rotation};
}

PlanarDerivative planar_derivative(const PlanarPrior& prior, const RelativePose& first,
                                   const RelativePose& second) {
  using Vector3 = Eigen::Map<const Eigen::Vector3d>;
  const Vector3 down(prior.down), right(prior.right), ahead(prior.ahead);
  const Eigen::Vector3d turned = first.R * -(second.R.transpose() * second.t);
  const Eigen::Matrix3d R = second.R * first.R.transpose();
  const Eigen::Vector3d gravity = R * down;
  PlanarDerivative d{Eigen::Matrix<double, 3, 6>::Zero(), Eigen::Matrix<double, 3, 6>::Zero()};
  const Eigen::Matrix3d down_x = cross_matrix(down);
  const Eigen::Matrix3d gravity_x = cross_matrix(gravity);
  d.first.row(0) << -down.transpose() * cross_matrix(turned), down.transpose();
  // t ← t + v moves the centre by −Rᵀ v; R ← exp([w]) R by −Rᵀ [t]× … of t: −(exp R)ᵀ t.
  const Eigen::Matrix3d to_first = R.transpose();
  d.second.row(0) << -down.transpose() * to_first * cross_matrix(second.t),
      -down.transpose() * to_first;
  d.first.row(1).head<3>() = ahead.transpose() * R * down_x;
  d.first.row(2).head<3>() = right.transpose() * R * down_x;
  d.second.row(1).head<3>() = -ahead.transpose() * gravity_x;
  d.second.row(2).head<3>() = -right.transpose() * gravity_x;
  const Eigen::Vector3d scale(1.0 / prior.sigma_travel, 1.0 / prior.sigma_rotation,
                              1.0 / prior.sigma_rotation);
  d.first = scale.asDiagonal() * d.first;
  d.second = scale.asDiagonal() * d.second;
  return d;
}

bool PlanarMotionCost::Evaluate(double const* const* blocks, double* residuals,
                                double** jacobians) const {
  const RelativePose first = load_pose(blocks[0]);
  const RelativePose second = load_pose(blocks[1]);
  const Eigen::Vector3d r = planar_residuals(prior_, first, second);
  std::copy_n(r.data(), 3, residuals);
  if (jacobians == nullptr) return true;
  const PlanarDerivative d = planar_derivative(prior_, first, second);
  store_pose_jacobian<3>(d.first, jacobians[0]);
  store_pose_jacobian<3>(d.second, jacobians[1]);
  return true;
}

template class ReprojectionCost<3>;
template class ReprojectionCost<5>;
template class AnchorCost<3>;
template class AnchorCost<5>;

}  // namespace oneac
