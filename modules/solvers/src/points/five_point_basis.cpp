#include "points/five_point_basis.h"

#include "planes/small_rotation.h"
#include "points/motion_essential.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace oneac::internal {
namespace {

// Gauss-Newton steps of the alignment: the third is below the parallax that it is to show.
constexpr int kAlignmentSteps = 3;
// Shares of the parallax below it are rounding.
constexpr double kLeastParallax = 1e-8;
// Length of the direction across [t]× R below which there is none: the rays do not fit a rotation
// at all, so there is plenty of parallax.
constexpr double kNoDirection = 1e-3;
// Unit normal of the plane to reflect at.
constexpr double kPlane[4] = {0.36, -0.48, 0.64, 0.48};

using Vector9 = Eigen::Matrix<double, 9, 1>;

/// Rotation that brings the rays of view 1 nearest to those of view 2.
[[nodiscard]] Eigen::Matrix3d aligning_rotation(const FiveRays& rays) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  for (int step = 0; step < kAlignmentSteps; ++step) {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (int i = 0; i < 5; ++i) {
      const Eigen::Vector3d a = R * rays.first[i];
      H += Eigen::Matrix3d::Identity() - a * a.transpose();
      g += a.cross(rays.second[i]);
    }
    const Eigen::Vector3d w = H.inverse() * g;
    if (!w.allFinite()) break;
    R = small_rotation(w) * R;
  }
  return R;
}

/// The vector orthogonal to three in four dimensions, as long as their volume.
[[nodiscard]] Eigen::Vector4d orthogonal_to(const Eigen::Matrix<double, 4, 3>& C) {
  Eigen::Vector4d w;
  for (int k = 0; k < 4; ++k) {
    Eigen::Matrix3d minor;
    for (int i = 0, row = 0; i < 4; ++i) {
      if (i != k) minor.row(row++) = C.row(i);
    }
    w(k) = (k % 2 == 0 ? 1.0 : -1.0) * minor.determinant();
  }
  return w;
}

}  // namespace

Basis well_scaled(const Basis& basis, const FiveRays& rays) {
  const Eigen::Matrix3d R = aligning_rotation(rays);
  Eigen::Matrix<double, 4, 3> C;  // the parts of [e_i]× R in the null space
  double outside = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Vector9 s = packed(std::sqrt(0.5) * cross_matrix(Eigen::Vector3d::Unit(i)) * R);
    C.col(i) = basis.transpose() * s;
    outside += (s - basis * C.col(i)).squaredNorm();
  }
  const double parallax = std::clamp(std::sqrt(outside / 3.0), kLeastParallax, 1.0);
  Basis scaled = basis;
  const Eigen::Vector4d across = orthogonal_to(C);
  if (across.norm() > kNoDirection) {
    const Eigen::Vector4d w = across.normalized();
    const Vector9 along = basis * w;
    scaled -= (1.0 - parallax) * along * w.transpose();
  }
  const Eigen::Vector4d normal = Eigen::Map<const Eigen::Vector4d>(kPlane);
  const Vector9 along = scaled * normal;
  return scaled - 2.0 * along * normal.transpose();
}

}  // namespace oneac::internal
