#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/solvers/span.h"

namespace oneac {

/// Levenberg–Marquardt on the Sampson error of all correspondences.
struct PolishOptions {
  double threshold = 1e-3;  ///< [-] scale of the robust loss, normalised image units
  int max_iterations = 20;
};

struct PolishResult {
  RelativePose pose;  ///< |t| = 1
  double cost = 0.0;  ///< Σ ρ at the result
  int iterations = 0;
};

/// Minimises Σ ρ(r_i) over the five degrees of freedom of (R, t/|t|), r the Sampson distance and
/// ρ(r) = r²/(r² + s²) (Geman–McClure, s = threshold): smooth, and far outliers weigh nothing.
/// Deterministic; never worse than the start. @pre pose.t ≠ 0
[[nodiscard]] PolishResult polish(const RelativePose& start, AcSpan acs,
                                  const PolishOptions& options);

/// Derivative of the Sampson distance with respect to (w, b): R ← exp([w]×) R, t ← t + b1 T1 + b2
/// T2 with the tangent basis (T1, T2) of the unit sphere at t. Public for its test.
struct SampsonJacobian {
  double r = 0.0;
  Eigen::Matrix<double, 1, 5> J = Eigen::Matrix<double, 1, 5>::Zero();
};
[[nodiscard]] SampsonJacobian sampson_jacobian(const RelativePose& pose, const Eigen::Vector2d& x1,
                                               const Eigen::Vector2d& x2);

/// The step of the parameters above: exp([w]×) R, normalised t + T b.
[[nodiscard]] RelativePose retract(const RelativePose& pose,
                                   const Eigen::Matrix<double, 5, 1>& step);

}  // namespace oneac
