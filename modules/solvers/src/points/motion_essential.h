#pragma once

#include "math/epipolar_rows.h"
#include "planes/small_rotation.h"

#include "oneac/geometry/relative_pose.h"
#include "oneac/geometry/tangent_basis.h"

#include <Eigen/Dense>

namespace oneac::internal {

[[nodiscard]] inline Vector9 packed(const Eigen::Matrix3d& E) {
  Vector9 rows;
  rows << E.row(0).transpose(), E.row(1).transpose(), E.row(2).transpose();
  return rows;
}

/// E = [t]× R row by row and its derivatives by the rotation vector of R ← exp([ω]×) R and by t
/// along its tangents; a model of descend().
struct MotionEssential {
  RelativePose T;
  Eigen::Matrix<double, 3, 2> tangents;
  Vector9 e;
  Eigen::Matrix<double, 9, 5> J;

  explicit MotionEssential(const RelativePose& of) : T(of), tangents(tangent_basis(of.t)) {
    const Eigen::Matrix3d t = cross_matrix(T.t);
    e = packed(t * T.R);
    for (int i = 0; i < 3; ++i) {
      J.col(i) = packed(t * cross_matrix(Eigen::Vector3d::Unit(i)) * T.R);
    }
    for (int i = 0; i < 2; ++i) J.col(i + 3) = packed(cross_matrix(tangents.col(i)) * T.R);
  }

  [[nodiscard]] MotionEssential moved(const Eigen::Matrix<double, 5, 1>& by) const {
    return MotionEssential(
        {small_rotation(by.head<3>()) * T.R, (T.t + tangents * by.tail<2>()).normalized()});
  }
};

}  // namespace oneac::internal
