#include "oneac/geometry/relative_pose.h"

#include <Eigen/Geometry>

#include <cmath>

namespace oneac {
namespace {

// Below this squared angle [rad²] five terms of the series are exact to rounding, and faster than
// sine and cosine: the steps of iterations.
constexpr double kSmallAngleSquared = 0.01;

/// Rodrigues' formula I + a [w]× + b [w]×² with sin θ / θ and (1 − cos θ) / θ² as power series.
[[nodiscard]] Eigen::Matrix3d small_rotation_from_vector(const Eigen::Vector3d& w, double squared) {
  const double s = squared;
  const double a = 1.0 - s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0)));
  const double b = 0.5 - s / 24.0 * (1.0 - s / 30.0 * (1.0 - s / 56.0 * (1.0 - s / 90.0)));
  const Eigen::Matrix3d W = cross_matrix(w);
  return Eigen::Matrix3d::Identity() + a * W + b * (W * W);
}

}  // namespace

RelativePose operator*(const RelativePose& T_3_2, const RelativePose& T_2_1) {
  return {T_3_2.R * T_2_1.R, T_3_2.R * T_2_1.t + T_3_2.t};
}

Eigen::Matrix3d yaw_rotation(double cos_alpha, double sin_alpha) {
  Eigen::Matrix3d R;
  R << cos_alpha, 0.0, -sin_alpha, 0.0, 1.0, 0.0, sin_alpha, 0.0, cos_alpha;  // eq. (2)
  return R;
}

Eigen::Matrix3d pitch_rotation(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix();
}

Eigen::Matrix3d roll_rotation(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

Eigen::Matrix3d rotation_from_vector(const Eigen::Vector3d& w) {
  const double squared = w.squaredNorm();
  if (squared < kSmallAngleSquared) return small_rotation_from_vector(w, squared);
  const double angle = std::sqrt(squared);
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

}  // namespace oneac
