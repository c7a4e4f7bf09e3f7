#pragma once

#include <Eigen/Core>

namespace oneac {

/// Rigid motion T_2_1 of points from the first camera to the second: X2 = R X1 + t.
///
/// Camera frames have X right, Y down, Z forward. Whether t carries a length is said by whoever
/// returns the pose; without one it is a unit vector, or zero when the camera did not move.
struct RelativePose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();

  /// X2 = R X1 + t.
  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& X1) const { return R * X1 + t; }
  [[nodiscard]] RelativePose inverse() const { return {R.transpose(), -(R.transpose() * t)}; }
  [[nodiscard]] bool is_finite() const { return R.allFinite() && t.allFinite(); }
};

/// T_3_1 = T_3_2 * T_2_1.
[[nodiscard]] RelativePose operator*(const RelativePose& T_3_2, const RelativePose& T_2_1);

/// The yaw rotation of planar motion, rows (c, 0, −s), (0, 1, 0), (s, 0, c)   [Gal 2020, eq. (2)].
[[nodiscard]] Eigen::Matrix3d yaw_rotation(double cos_alpha, double sin_alpha);

/// Rotation about the X axis (pitch) by the angle [rad], right-handed.
[[nodiscard]] Eigen::Matrix3d pitch_rotation(double angle);

/// Rotation about the Z axis (roll) by the angle [rad], right-handed.
[[nodiscard]] Eigen::Matrix3d roll_rotation(double angle);

/// [v]×, the matrix of the cross product: [v]× w = v × w.
[[nodiscard]] Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

/// Rotation by the angle |w| about the axis w / |w| (the exponential map of SO(3)).
[[nodiscard]] Eigen::Matrix3d rotation_from_vector(const Eigen::Vector3d& w);

}  // namespace oneac
