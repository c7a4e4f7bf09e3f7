#include "oneac/geometry/driven_path.h"

#include <cmath>

namespace oneac {
namespace {

constexpr double kAlongAxis = 0.9;  // cos 25°

}  // namespace

DrivenPath::DrivenPath(const RelativePose& T_2_1, const Eigen::Matrix3d& R_level_cam) {
  const Eigen::Vector3d way = R_level_cam * (T_2_1.R.transpose() * -T_2_1.t);
  const double length = way.norm();
  if (!(std::abs(way.z()) > kAlongAxis * length) || !std::isfinite(length)) return;
  const Eigen::Vector3d axis = R_level_cam * T_2_1.R.row(2).transpose();
  const Eigen::Vector3d before = R_level_cam.col(2);
  const double turn = std::atan2(axis.x(), axis.z()) - std::atan2(before.x(), before.z());
  const double curvature = turn / std::copysign(length, way.z());
  if (std::isfinite(curvature)) curvature_ = curvature;
}

std::optional<double> DrivenPath::at(double z) const {
  // x = ρ − √(ρ² − z²), ρ = 1/κ, without a difference of what is nearly the same.
  const double turned = curvature_ * z;
  if (!(std::abs(turned) < 1.0)) return std::nullopt;
  return turned * z / (1.0 + std::sqrt(1.0 - turned * turned));
}

}  // namespace oneac
