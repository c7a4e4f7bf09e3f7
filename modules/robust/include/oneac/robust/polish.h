#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/geometry/tangent_basis.h"
#include "oneac/robust/point_set.h"
#include "oneac/solvers/span.h"

namespace oneac {

/// Levenberg–Marquardt on the Sampson error of all correspondences.
struct PolishOptions {
  double threshold = 1e-3;  ///< [-] scale of the robust loss, normalised image units
  int max_iterations = 20;
  double converged = 1e-6;  ///< [rad] a smaller step ends it; what noise leaves is 1e-4 and more
  /// The start lies within the loss's width of the minimum: Newton at once, else when steps say so
  bool starts_near = false;
};

struct PolishResult {
  RelativePose pose;  ///< |t| = 1
  double cost = 0.0;  ///< Σ ρ at the result
  int iterations = 0;
  /// Σ ω JᵀJ of (w, b) with the basis of tangent_basis(pose.t), ω = 1 for a perfect point and
  /// falling to 0: the inverse times the variance of the residuals is the covariance.
  Eigen::Matrix<double, 5, 5> information = Eigen::Matrix<double, 5, 5>::Zero();
};

/// Minimises Σ ρ(r_i) over the five degrees of freedom of (R, t/|t|), r the Sampson distance and
/// ρ(r) = r²/(r² + s²) (Geman–McClure, s = threshold): smooth, and far outliers weigh nothing.
/// Deterministic, the same bits on every machine; never worse than the start. @pre start.t ≠ 0
[[nodiscard]] PolishResult polish(const RelativePose& start, AcSpan acs,
                                  const PolishOptions& options);
[[nodiscard]] PolishResult polish(const RelativePose& start, const PrecisePointSet& points,
                                  const PolishOptions& options);
/// In single precision: a third of the time, good to about 1e-4 rad. For ranking candidates.
[[nodiscard]] PolishResult polish_coarsely(const RelativePose& start, const PointSet& points,
                                           const PolishOptions& options);

/// The step of the parameters (w, b): exp([w]×) R, normalised t + b1 T1 + b2 T2 with the tangent
/// basis at t.
[[nodiscard]] RelativePose retract(const RelativePose& pose,
                                   const Eigen::Matrix<double, 5, 1>& step);

}  // namespace oneac
