#pragma once

#include "math/usable.h"

#include "oneac/solvers/span.h"

#include <Eigen/Core>

#include <cmath>

namespace oneac::internal {

/// Hartley's normalisation of one view: x ↦ s (x − m), centroid to the origin, mean squared length
/// to two.
struct Normalisation {
  Eigen::Vector2d m = Eigen::Vector2d::Zero();
  double s = 1.0;

  [[nodiscard]] Eigen::Vector2d operator*(const Eigen::Vector2d& x) const { return s * (x - m); }
  [[nodiscard]] Eigen::Matrix3d matrix() const {
    Eigen::Matrix3d T;
    T << s, 0.0, -s * m.x(), 0.0, s, -s * m.y(), 0.0, 0.0, 1.0;
    return T;
  }
  [[nodiscard]] Eigen::Matrix3d inverse_matrix() const {
    Eigen::Matrix3d T;
    T << 1.0 / s, 0.0, m.x(), 0.0, 1.0 / s, m.y(), 0.0, 0.0, 1.0;
    return T;
  }
};

/// Which correspondences take part.
[[nodiscard]] inline bool takes_part(AcSpan acs, const double* weights, std::size_t i) {
  return (weights == nullptr || weights[i] > 0.0) && has_points(acs[i]);
}

/// Normalisation of the points `view` (&AffineCorrespondence::x1 or x2); false for fewer than two
/// places.
[[nodiscard]] inline bool normalise(AcSpan acs, const double* weights,
                                    Eigen::Vector2d AffineCorrespondence::*view, Normalisation& N) {
  double count = 0.0;
  N.m.setZero();
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (!takes_part(acs, weights, i)) continue;
    N.m += acs[i].*view;
    count += 1.0;
  }
  if (!(count > 0.0)) return false;
  N.m /= count;
  double squares = 0.0;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (takes_part(acs, weights, i)) squares += (acs[i].*view - N.m).squaredNorm();
  }
  N.s = std::sqrt(2.0 * count / squares);
  return std::isfinite(N.s) && N.s > 0.0 && N.s < 1e9;
}

}  // namespace oneac::internal
