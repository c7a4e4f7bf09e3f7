#pragma once

namespace oneac {

// Weights of iteratively reweighted least squares: the slope ρ' of a robust loss by its squared
// residual, 1 for a perfect observation. All arguments are squares of one unit; c is the loss's
// scale. (The SIMD kernels of modules/robust have the same losses over lanes.)

/// Geman–McClure, ρ = r² / (1 + r²/c²): (c² / (r² + c²))², so far outliers weigh nothing.
[[nodiscard]] inline double geman_mcclure_weight(double squared_residual, double squared_scale) {
  const double share = squared_scale / (squared_residual + squared_scale);
  return share * share;
}

/// What geman_mcclure_weight divides by, (1 + r²/c²)²: for weights that have another factor.
[[nodiscard]] inline double geman_mcclure_divisor(double squared_residual, double squared_scale) {
  const double excess = 1.0 + squared_residual / squared_scale;
  return excess * excess;
}

/// Cauchy, ρ = c² log(1 + r²/c²): 1 / (1 + r²/c²), as ceres::CauchyLoss.
[[nodiscard]] inline double cauchy_weight(double squared_residual, double squared_scale) {
  return 1.0 / (1.0 + squared_residual / squared_scale);
}

}  // namespace oneac
