#pragma once

#include "math/usable.h"

#include "oneac/geometry/affine_correspondence.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>

namespace oneac::internal {

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Gram9 = Eigen::Matrix<double, 9, 9>;

/// The three equations of one correspondence on a whole E, row by row: the epipolar one and the two
/// affine-epipolar ones.
[[nodiscard]] inline Eigen::Matrix<double, 3, 9> epipolar_rows(const AffineCorrespondence& ac) {
  const double x = ac.x1.x(), y = ac.x1.y(), u = ac.x2.x(), v = ac.x2.y();
  const double a1 = ac.A(0, 0), a2 = ac.A(0, 1), a3 = ac.A(1, 0), a4 = ac.A(1, 1);
  Eigen::Matrix<double, 3, 9> m;
  m << u * x, u * y, u, v * x, v * y, v, x, y, 1.0,                   //
      a1 * x + u, a1 * y, a1, a3 * x + v, a3 * y, a3, 1.0, 0.0, 0.0,  //
      a2 * x, a2 * y + u, a2, a4 * x, a4 * y + v, a4, 0.0, 1.0, 0.0;
  return m;
}

/// Whether correspondence i takes part: usable, and not weighted away.
[[nodiscard]] inline bool counts(AcSpan acs, const double* weights, std::size_t i) {
  return (weights == nullptr || weights[i] > 0.0) && is_usable(acs[i]);
}

/// Which correspondence takes part when it is the only one: normal equations would lose half the
/// digits of its exact solution.
[[nodiscard]] inline std::optional<std::size_t> only_one(AcSpan acs, const double* weights) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (!counts(acs, weights, i)) continue;
    if (found) return std::nullopt;
    found = i;
  }
  return found;
}

/// Σ w rowsᵀ rows over those that take part; the affine rows times `affine_scale`.
[[nodiscard]] inline Gram9 epipolar_gram(AcSpan acs, const double* weights,
                                         double affine_scale = 1.0) {
  Gram9 gram = Gram9::Zero();
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (!counts(acs, weights, i)) continue;
    Eigen::Matrix<double, 3, 9> rows = epipolar_rows(acs[i]);
    rows.bottomRows<2>() *= affine_scale;
    gram.noalias() += (weights == nullptr ? 1.0 : weights[i]) * rows.transpose() * rows;
  }
  return gram;
}

}  // namespace oneac::internal
