#pragma once

#include <cmath>
#include <cstddef>

namespace oneac::internal {

/// Inverse of a small symmetric positive definite matrix.
template <std::size_t kSize>
class SpdInverse {
 public:
  /// From the upper triangle, row by row. False when the matrix is singular to working precision of
  /// its single-precision entries.
  [[nodiscard]] bool set(const float* upper) {
    double L[kSize][kSize] = {};
    std::size_t k = 0;
    for (std::size_t row = 0; row < kSize; ++row) {
      for (std::size_t column = row; column < kSize; ++column) {
        L[column][row] = static_cast<double>(upper[k++]);
      }
    }
    return factor(L) && invert(L);
  }

  [[nodiscard]] double operator()(std::size_t row, std::size_t column) const {
    return inverse_[row][column];
  }

  void multiply(const float* vector, double* product) const {
    for (std::size_t row = 0; row < kSize; ++row) {
      product[row] = 0.0;
      for (std::size_t column = 0; column < kSize; ++column) {
        product[row] += inverse_[row][column] * static_cast<double>(vector[column]);
      }
    }
  }

 private:
  // A pivot that loses this share of its diagonal entry is rounding of single-precision sums.
  static constexpr double kSingular = 1e-5;

  static bool factor(double (&L)[kSize][kSize]) {
    for (std::size_t j = 0; j < kSize; ++j) {
      const double diagonal = L[j][j];
      for (std::size_t k = 0; k < j; ++k) L[j][j] -= L[j][k] * L[j][k];
      if (!(L[j][j] > kSingular * diagonal)) return false;
      L[j][j] = std::sqrt(L[j][j]);
      for (std::size_t i = j + 1; i < kSize; ++i) {
        for (std::size_t k = 0; k < j; ++k) L[i][j] -= L[i][k] * L[j][k];
        L[i][j] /= L[j][j];
      }
    }
    return true;
  }

  /// L⁻ᵀ L⁻¹.
  bool invert(const double (&L)[kSize][kSize]) {
    double G[kSize][kSize] = {};  // L⁻¹
    for (std::size_t j = 0; j < kSize; ++j) {
      G[j][j] = 1.0 / L[j][j];
      for (std::size_t i = j + 1; i < kSize; ++i) {
        double sum = 0.0;
        for (std::size_t k = j; k < i; ++k) sum -= L[i][k] * G[k][j];
        G[i][j] = sum / L[i][i];
      }
    }
    for (std::size_t i = 0; i < kSize; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = 0.0;
        for (std::size_t k = i; k < kSize; ++k) sum += G[k][i] * G[k][j];
        inverse_[i][j] = inverse_[j][i] = sum;
      }
    }
    return true;
  }

  double inverse_[kSize][kSize] = {};
};

}  // namespace oneac::internal
