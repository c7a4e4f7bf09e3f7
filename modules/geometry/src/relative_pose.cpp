#include "oneac/geometry/relative_pose.h"

#include <Eigen/Geometry>

#include <cmath>

namespace oneac {

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
  const double angle = w.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

}  // namespace oneac
