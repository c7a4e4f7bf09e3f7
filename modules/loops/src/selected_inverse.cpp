#include "selected_inverse.h"

#include <Eigen/SparseCholesky>

#include <algorithm>

namespace oneac::internal {
namespace {

using Factor = Eigen::SimplicialLDLT<SelectedInverse::Matrix, Eigen::Lower>;

}  // namespace

std::optional<SelectedInverse> SelectedInverse::of(const Matrix& lower) {
  const Factor factor(lower);
  if (factor.info() != Eigen::Success) return std::nullopt;
  SelectedInverse inverse;
  inverse.D_ = factor.vectorD();
  if (!(inverse.D_.minCoeff() > 0.0) || !inverse.D_.allFinite()) return std::nullopt;
  inverse.L_ = factor.matrixL().nestedExpression();
  inverse.place_ = factor.permutationP().indices();
  inverse.recurse();
  return inverse;
}

double SelectedInverse::entry(Eigen::Index row, Eigen::Index column) const {
  if (row == column) return Z_diag_[row];
  if (row < column) std::swap(row, column);
  const auto* begin = Z_.innerIndexPtr() + Z_.outerIndexPtr()[column];
  const auto* end = Z_.innerIndexPtr() + Z_.outerIndexPtr()[column + 1];
  const auto* found = std::lower_bound(begin, end, static_cast<int>(row));
  if (found == end || *found != row) return 0.0;
  return Z_.valuePtr()[found - Z_.innerIndexPtr()];
}

// Column by column from the last: Z_ij = −Σ_k L_kj Z_ik and Z_jj = 1 / D_j − Σ_k L_kj Z_kj over
// the rows k of L's column j, all of whose pairs are in the pattern.
void SelectedInverse::recurse() {
  Z_ = L_;
  Z_diag_ = D_.cwiseInverse();
  for (Eigen::Index j = L_.cols() - 1; j >= 0; --j) {
    for (Matrix::InnerIterator z(Z_, j); z; ++z) {
      double sum = 0.0;
      for (Matrix::InnerIterator l(L_, j); l; ++l) sum += l.value() * entry(z.row(), l.row());
      z.valueRef() = -sum;
    }
    Matrix::InnerIterator z(Z_, j);
    for (Matrix::InnerIterator l(L_, j); l; ++l, ++z) Z_diag_[j] -= l.value() * z.value();
  }
}

double SelectedInverse::at(Eigen::Index row, Eigen::Index column) const {
  return entry(place_[row], place_[column]);
}

Eigen::VectorXd SelectedInverse::times(const Eigen::VectorXd& b) const {
  Eigen::VectorXd x(b.size());
  for (Eigen::Index i = 0; i < b.size(); ++i) x[place_[i]] = b[i];
  L_.triangularView<Eigen::UnitLower>().solveInPlace(x);
  x = x.cwiseQuotient(D_).eval();
  L_.transpose().triangularView<Eigen::UnitUpper>().solveInPlace(x);
  Eigen::VectorXd back(b.size());
  for (Eigen::Index i = 0; i < b.size(); ++i) back[i] = x[place_[i]];
  return back;
}

}  // namespace oneac::internal
