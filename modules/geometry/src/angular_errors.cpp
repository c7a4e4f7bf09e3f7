#include "oneac/geometry/angular_errors.h"

#include <Eigen/Dense>

#include <cmath>

namespace oneac {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;

}  // namespace

double rotation_error(const Eigen::Matrix3d& R_est, const Eigen::Matrix3d& R_ref) {
  // acos loses half the digits near zero; atan2 of twice sine and twice cosine does not.
  const Eigen::Matrix3d R = R_est * R_ref.transpose();
  const Eigen::Vector3d twice_sine(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return std::atan2(twice_sine.norm(), R.trace() - 1.0);
}

double direction_error(const Eigen::Vector3d& t_est, const Eigen::Vector3d& t_ref) {
  const double cosine = t_est.dot(t_ref);
  const double sine = t_est.cross(t_ref).norm();
  if (!(t_est.squaredNorm() > 0.0) || !(t_ref.squaredNorm() > 0.0)) return 0.5 * kHalfTurn;
  return std::atan2(sine, cosine);
}

double normal_error(const Eigen::Vector3d& n_est, const Eigen::Vector3d& n_ref) {
  const double angle = direction_error(n_est, n_ref);
  return std::min(angle, kHalfTurn - angle);
}

}  // namespace oneac
