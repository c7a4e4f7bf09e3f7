#pragma once

#include <Eigen/Core>

#include <cmath>

namespace oneac::internal {

/// Solves H x = b by H = L D Lᵀ, unrolled for the small fixed sizes of normal equations.
/// @param H  symmetric; its lower triangle is read
/// @return   false when H is not positive definite or not finite; x is then not set
template <int kSize>
[[nodiscard]] bool solve_positive(const Eigen::Matrix<double, kSize, kSize>& H,
                                  const Eigen::Matrix<double, kSize, 1>& b,
                                  Eigen::Matrix<double, kSize, 1>& x) {
  double L[kSize][kSize];  // below the diagonal; a row is L D until its pivot's turn
  double inverse[kSize];   // of the pivots
  double z[kSize];
  for (int j = 0; j < kSize; ++j) {
    double pivot = H(j, j);
    z[j] = b(j);
    for (int k = 0; k < j; ++k) {
      const double unscaled = L[j][k];
      L[j][k] *= inverse[k];
      pivot -= unscaled * L[j][k];
      z[j] -= L[j][k] * z[k];
    }
    if (!(pivot > 0.0) || !std::isfinite(pivot)) return false;
    inverse[j] = 1.0 / pivot;
    for (int i = j + 1; i < kSize; ++i) {
      double entry = H(i, j);
      for (int k = 0; k < j; ++k) entry -= L[i][k] * L[j][k];
      L[i][j] = entry;
    }
  }
  for (int j = kSize - 1; j >= 0; --j) {
    z[j] *= inverse[j];
    for (int i = j + 1; i < kSize; ++i) z[j] -= L[i][j] * z[i];
  }
  for (int j = 0; j < kSize; ++j) x(j) = z[j];
  return true;
}

}  // namespace oneac::internal
