#include "oneac/robust/rotation_only.h"

#include "oneac/geometry/relative_pose.h"

#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace oneac {
namespace {

constexpr double kFirstScale =
    16.0;  // of the threshold: reaches 16 px of turning between two frames
constexpr int kIterationsPerScale = 3;

/// One reweighted Gauss–Newton step of R ← exp([w]×) R.
Eigen::Vector3d rotation_step(const Eigen::Matrix3d& R, AcSpan acs, double scale) {
  Eigen::Matrix3d H = 1e-12 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  for (const AffineCorrespondence& ac : acs) {
    const Eigen::Vector3d y = R * ac.x1.homogeneous();
    if (!(y.z() > 1e-6)) continue;
    const double u = y.x() / y.z();
    const double v = y.y() / y.z();
    Eigen::Matrix<double, 2, 3> J;  // ∂π(exp([w]×) y)/∂w at w = 0
    J << -u * v, 1.0 + u * u, -v, -1.0 - v * v, u * v, u;
    const Eigen::Vector2d r = Eigen::Vector2d(u, v) - ac.x2;
    const double sum = r.squaredNorm() + scale * scale;
    const double weight = scale * scale / (sum * sum);
    H += weight * J.transpose() * J;
    g += weight * J.transpose() * r;
  }
  return -H.ldlt().solve(g);
}

}  // namespace

Eigen::Matrix3d fit_rotation(AcSpan acs, double threshold) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  for (double scale = kFirstScale; scale >= 1.0; scale /= 2.0) {
    for (int i = 0; i < kIterationsPerScale; ++i) {
      const Eigen::Vector3d step = rotation_step(R, acs, scale * threshold);
      if (!step.allFinite()) return R;
      R = rotation_from_vector(step) * R;
    }
  }
  return R;
}

std::vector<double> rotation_transfer_errors(const Eigen::Matrix3d& R, AcSpan acs) {
  std::vector<double> errors;
  errors.reserve(acs.size());
  for (const AffineCorrespondence& ac : acs) {
    const Eigen::Vector3d y = R * ac.x1.homogeneous();
    errors.push_back(y.z() > 1e-6 ? (y.head<2>() / y.z() - ac.x2).norm()
                                  : std::numeric_limits<double>::infinity());
  }
  return errors;
}

}  // namespace oneac
