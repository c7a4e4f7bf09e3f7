#pragma once

#include <Eigen/Core>

#include <cmath>
#include <utility>

namespace oneac::internal {

/// Orthonormal basis of the null space of an R×C matrix of full rank R, by elimination with
/// complete pivoting; false when the rank is lower (a pivot below `singular` times the first).
/// Of more rows than R the R that say most are used: those of the largest pivots.
template <int R, int C, int Rows = R>
[[nodiscard]] bool null_space(Eigen::Matrix<double, Rows, C> m, double singular,
                              Eigen::Matrix<double, C, C - R>& basis) {
  int column[C];
  for (int i = 0; i < C; ++i) column[i] = i;
  double first = 0.0;
  for (int k = 0; k < R; ++k) {
    int row = k, col = k;
    double largest = -1.0;
    for (int j = k; j < C; ++j) {
      for (int i = k; i < Rows; ++i) {
        if (std::abs(m(i, j)) > largest) largest = std::abs(m(i, j)), row = i, col = j;
      }
    }
    if (k == 0) first = largest;
    if (!(largest > singular * first) || !std::isfinite(largest)) return false;
    if (row != k) m.row(row).swap(m.row(k));
    if (col != k) {
      m.col(col).swap(m.col(k));
      std::swap(column[col], column[k]);
    }
    const double inverse = 1.0 / m(k, k);
    for (int i = k + 1; i < Rows; ++i) {
      const double factor = m(i, k) * inverse;
      for (int j = k + 1; j < C; ++j) m(i, j) -= factor * m(k, j);
    }
  }
  for (int f = 0; f < C - R; ++f) {  // one free unknown at a time is one
    double x[C] = {};
    x[R + f] = 1.0;
    for (int k = R - 1; k >= 0; --k) {
      double sum = m(k, R + f);
      for (int j = k + 1; j < R; ++j) sum += m(k, j) * x[j];
      x[k] = -sum / m(k, k);
    }
    for (int j = 0; j < C; ++j) basis(column[j], f) = x[j];
  }
  for (int f = 0; f < C - R; ++f) {
    for (int pass = 0; pass < 2; ++pass) {
      for (int g = 0; g < f; ++g) basis.col(f) -= basis.col(g).dot(basis.col(f)) * basis.col(g);
    }
    basis.col(f).normalize();
  }
  return basis.allFinite();
}

}  // namespace oneac::internal
