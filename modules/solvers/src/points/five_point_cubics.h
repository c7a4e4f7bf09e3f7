#pragma once

#include <Eigen/Core>

namespace oneac::internal {

/// Null space of five epipolar equations: E row by row is X x + Y y + Z z + W.
using Basis = Eigen::Matrix<double, 9, 4>;

/// A row of Nistér's B(z): polynomials in z for x, y (degree three) and 1 (degree four), ascending.
struct PolynomialRow {
  double x[4];
  double y[4];
  double one[5];
};

/// B(z) of a basis: the ten cubics E Eᵀ E = ½ tr(E Eᵀ) E, det E = 0, eliminated; false when they
/// are dependent, that is, when there is a continuum of solutions.
[[nodiscard]] bool five_point_rows(const Basis& basis, PolynomialRow (&B)[3]);

/// det B(z), degree ten, ascending.
void determinant(const PolynomialRow (&B)[3], double (&d)[11]);

}  // namespace oneac::internal
