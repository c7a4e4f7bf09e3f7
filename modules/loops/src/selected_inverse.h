#pragma once

#include <Eigen/SparseCore>

#include <optional>

namespace oneac::internal {

/// The inverse of a symmetric positive definite matrix, where the matrix itself or its factor has
/// entries: what is near the diagonal of a drive costs as much as factoring, all of it would fill
/// the memory.
///
/// Takahashi's recursion [Takahashi, Fagan and Chen 1973]: of A = L D Lᵀ, Z = A⁻¹ obeys
/// Z = D⁻¹ L⁻¹ + (I − Lᵀ) Z; from the last column to the first, each entry within the pattern of L
/// needs such entries alone.
class SelectedInverse {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  /// @param lower  the lower triangle at least
  /// @return empty when it is not positive definite
  [[nodiscard]] static std::optional<SelectedInverse> of(const Matrix& lower);

  /// Of the inverse. @pre the matrix has an entry there, be it 0
  [[nodiscard]] double at(Eigen::Index row, Eigen::Index column) const;
  /// A⁻¹ b.
  [[nodiscard]] Eigen::VectorXd times(const Eigen::VectorXd& b) const;

 private:
  SelectedInverse() = default;
  void recurse();
  /// Entry of the permuted inverse below the diagonal or on it; 0 beyond the pattern.
  [[nodiscard]] double entry(Eigen::Index row, Eigen::Index column) const;

  Matrix L_;                ///< strictly lower, of the permuted matrix
  Eigen::VectorXd D_;       ///< diagonal of the factor
  Eigen::VectorXi place_;   ///< of each row in the permuted matrix
  Matrix Z_;                ///< as L_
  Eigen::VectorXd Z_diag_;  ///< and the diagonal
};

}  // namespace oneac::internal
