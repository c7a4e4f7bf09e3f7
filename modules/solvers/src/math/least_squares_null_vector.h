#pragma once

#include <Eigen/Eigenvalues>

#include <optional>

namespace oneac::internal {

/// Unit e that minimises Σ w |M e|² over weighted blocks M of rows, with the digits that the rows
/// have. `for_each_block(use)` calls use(M, w) for each, M with N columns. Empty when the second
/// eigenvalue of the normal matrix is below `singular` times the largest, or it is not finite.
///
/// Normal equations alone keep half of the digits: what Σ w Mᵀ (M e), computed from the rows, has
/// along the other eigenvectors is the error of e to first order, and is taken off.
template <int N, class ForEachBlock>
[[nodiscard]] std::optional<Eigen::Matrix<double, N, 1>> least_squares_null_vector(
    ForEachBlock&& for_each_block, double singular) {
  using Vector = Eigen::Matrix<double, N, 1>;
  using Gram = Eigen::Matrix<double, N, N>;
  Gram gram = Gram::Zero();
  for_each_block(
      [&](const auto& M, double weight) { gram.noalias() += weight * M.transpose() * M; });
  if (!(gram.trace() > 0.0) || !gram.allFinite()) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Gram> eigen(gram);
  const Vector& values = eigen.eigenvalues();
  if (!(values(1) > singular * values(N - 1))) return std::nullopt;
  Vector e = eigen.eigenvectors().col(0);
  Vector rest = Vector::Zero();
  for_each_block([&](const auto& M, double weight) {
    const auto residual = (M * e).eval();
    rest.noalias() += weight * M.transpose() * residual;
  });
  for (int k = 1; k < N; ++k) {
    const double gap = values(k) - values(0);
    if (gap > 0.0) e -= (eigen.eigenvectors().col(k).dot(rest) / gap) * eigen.eigenvectors().col(k);
  }
  return e.normalized();
}

}  // namespace oneac::internal
