#pragma once

#include "math/thresholds.h"

#include <Eigen/Core>

#include <cmath>

namespace oneac::internal {

/// zᵀ Q z − 2 hᵀ z for z = (c, s) on the unit circle, Q symmetric positive semidefinite.
struct CircleProblem {
  double cc, cs, ss;  ///< of Q
  double cb, sb;      ///< h
};

/// The minimum on the circle by Halley's method from λ = 0, where the solution without noise lies,
/// in the basis of Q. With n(λ) = det(Q + λI) (Q + λI)⁻¹ h, which is linear in λ, the secular
/// equation |n|² = det² is a quartic: no root is taken and one division made per step. False near
/// the hard case and when Q + λI is not positive definite, that is, for another root.
[[nodiscard]] inline bool minimise_near_circle(const CircleProblem& r, double& c, double& s) {
  const double T = r.cc + r.ss;
  const double D = r.cc * r.ss - r.cs * r.cs;
  const double n0 = r.ss * r.cb - r.cs * r.sb;
  const double n1 = r.cc * r.sb - r.cs * r.cb;
  const double c0 = D * D - (n0 * n0 + n1 * n1);
  const double c1 = 2.0 * (T * D - (n0 * r.cb + n1 * r.sb));
  const double c2 = T * T + 2.0 * D - (r.cb * r.cb + r.sb * r.sb);
  double lambda = 0.0;
  double value = c0, slope = c1, bend = c2;
  for (int step = 0; step < kHalleySteps; ++step) {
    const double delta = value * slope / (value * bend - slope * slope);
    lambda += delta;
    const double det = D + lambda * (T + lambda);
    const double trace = T + 2.0 * lambda;
    if (!(trace > 0.0) || !(det > kNearHardCase * trace * trace)) return false;
    if (std::abs(delta) * trace <= kHalleyStep * det) {  // det/trace < smallest eigenvalue
      const double x = n0 + lambda * r.cb, y = n1 + lambda * r.sb;
      const double length = std::sqrt(x * x + y * y);
      if (!(length > 0.0)) return false;
      c = x / length;
      s = y / length;
      return true;
    }
    const double squared = lambda * lambda;
    value = c0 + lambda * c1 + squared * (c2 + lambda * (2.0 * T + lambda));
    slope = c1 + 2.0 * lambda * c2 + squared * (6.0 * T + 4.0 * lambda);
    bend = c2 + 6.0 * (lambda * T + squared);
  }
  return false;
}

/// The minimum wherever it is, the hard case included, by the eigenvectors of Q.
void minimise_far_from_circle(const CircleProblem& problem, double& c, double& s);

/// z = argmin zᵀ Q z − 2 hᵀ z on the unit circle, Q symmetric positive semidefinite.
[[nodiscard]] Eigen::Vector2d minimise_on_circle(const Eigen::Matrix2d& Q,
                                                 const Eigen::Vector2d& h);

}  // namespace oneac::internal
