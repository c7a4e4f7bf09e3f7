#include "patch_geometry.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace oneac {
namespace {

// [1/length] ten kilometres, for lengths in metres: as good as infinity.
constexpr double kFarthest = 1e-4;

}  // namespace

double inverse_depth_of(const RelativePose& T_2_1, const Eigen::Vector2d& x1,
                        const Eigen::Vector2d& x2) {
  const Eigen::Vector3d p = T_2_1.R * x1.homogeneous();
  const Eigen::Vector2d a = p.head<2>() - x2 * p.z();
  const Eigen::Vector2d b = T_2_1.t.head<2>() - x2 * T_2_1.t.z();
  const double rho = b.squaredNorm() > 0.0 ? -a.dot(b) / b.squaredNorm() : 0.0;
  // In front of the second view too: p_z + ρ t_z > 0, with a margin of a tenth.
  const double most = T_2_1.t.z() < 0.0 ? 0.9 * p.z() / -T_2_1.t.z() : rho;
  return std::max(std::min(rho, most), kFarthest);
}

double depth_information(const RelativePose& T_2_1, const Eigen::Vector2d& x1, double inverse_depth,
                         double sigma) {
  const Eigen::Vector3d y = T_2_1.R * x1.homogeneous() + inverse_depth * T_2_1.t;
  if (!(y.z() > 0.0)) return 0.0;
  const Eigen::Vector2d u = y.head<2>() / y.z();
  const Eigen::Vector2d slope = (T_2_1.t.head<2>() - u * T_2_1.t.z()) / y.z();
  // Both ends of the track are noisy.
  return slope.squaredNorm() / (2.0 * sigma * sigma);
}

}  // namespace oneac
