#include "oneac/robust/rotation_only.h"

#include "oneac/base/median.h"
#include "oneac/geometry/relative_pose.h"
#include "oneac/geometry/robust_loss.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace oneac {
namespace {

constexpr int kIterationsPerScale = 3;

// Scales of refine_rotation: it starts within a few thresholds.
constexpr double kNearScale = 4.0;

struct RotationEquations {
  Eigen::Matrix3d H = 1e-12 * Eigen::Matrix3d::Identity();  ///< Σ ω JᵀJ
  Eigen::Vector3d g = Eigen::Vector3d::Zero();              ///< Σ ω Jᵀr
  double weighted_square = 0.0;                             ///< Σ ω |r|²
  double weight = 0.0;                                      ///< Σ ω
};

/// Normal equations of R ← exp([w]×) R, weights of the Geman–McClure loss, 1 for a perfect point.
RotationEquations equations(const Eigen::Matrix3d& R, AcSpan acs, double scale) {
  RotationEquations e;
  for (const AffineCorrespondence& ac : acs) {
    const Eigen::Vector3d y = R * ac.x1.homogeneous();
    if (!(y.z() > 1e-6)) continue;
    const double u = y.x() / y.z();
    const double v = y.y() / y.z();
    Eigen::Matrix<double, 2, 3> J;  // ∂π(exp([w]×) y)/∂w at w = 0
    J << -u * v, 1.0 + u * u, -v, -1.0 - v * v, u * v, u;
    const Eigen::Vector2d r = Eigen::Vector2d(u, v) - ac.x2;
    const double weight = geman_mcclure_weight(r.squaredNorm(), scale * scale);
    e.H += weight * J.transpose() * J;
    e.g += weight * J.transpose() * r;
    e.weighted_square += weight * r.squaredNorm();
    e.weight += weight;
  }
  return e;
}

/// Steps at scales first, first/2, … 1 threshold.
Eigen::Matrix3d descend(Eigen::Matrix3d R, AcSpan acs, double threshold, double first_scale) {
  double scale = first_scale;
  while (scale >= 1.0) {
    for (int i = 0; i < kIterationsPerScale; ++i) {
      const RotationEquations e = equations(R, acs, scale * threshold);
      const Eigen::Vector3d step = -e.H.ldlt().solve(e.g);
      if (!step.allFinite()) return R;
      R = rotation_from_vector(step) * R;
    }
    scale /= 2.0;
  }
  return R;
}

double transfer_error(const Eigen::Matrix3d& R, const AffineCorrespondence& ac) {
  const Eigen::Vector3d y = R * ac.x1.homogeneous();
  return y.z() > 1e-6 ? (y.head<2>() / y.z() - ac.x2).norm()
                      : std::numeric_limits<double>::infinity();
}

}  // namespace

RotationFit refine_rotation(const Eigen::Matrix3d& start, AcSpan acs, double threshold) {
  RotationFit fit;
  fit.R = descend(start, acs, threshold, kNearScale);
  const RotationEquations e = equations(fit.R, acs, threshold);
  if (!(e.weight > 0.0)) return fit;
  const double variance = e.weighted_square / (2.0 * e.weight);  // of one coordinate
  const Eigen::Matrix3d covariance = variance * e.H.ldlt().solve(Eigen::Matrix3d::Identity());
  if (covariance.allFinite()) fit.covariance = covariance;
  return fit;
}

std::vector<double> rotation_transfer_errors(const Eigen::Matrix3d& R, AcSpan acs) {
  std::vector<double> errors;
  errors.reserve(acs.size());
  for (const AffineCorrespondence& ac : acs) errors.push_back(transfer_error(R, ac));
  return errors;
}

double median_transfer_error(const Eigen::Matrix3d& R, AcSpan acs, std::size_t looked_at) {
  const std::size_t count = std::min(looked_at, acs.size());
  std::vector<double> errors(count);
  for (std::size_t k = 0; k < count; ++k) {
    errors[k] = transfer_error(R, acs[k * acs.size() / count]);
  }
  return upper_median(std::move(errors));
}

}  // namespace oneac
