#include "selected_inverse.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <random>
#include <vector>

namespace oneac::internal {
namespace {

/// A chain of blocks with some blocks far from the diagonal, as a drive with loops has them.
SelectedInverse::Matrix chain_with_loops(int size) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  Eigen::MatrixXd A = 8.0 * Eigen::MatrixXd::Identity(size, size);
  for (int i = 0; i + 1 < size; ++i) A(i, i + 1) = A(i + 1, i) = value(random);
  for (const auto& [i, j] : {std::pair(1, size - 2), std::pair(4, size - 5), std::pair(0, 9)}) {
    A(i, j) = A(j, i) = value(random);
  }
  return A.sparseView();
}

TEST(SelectedInverse, IsTheInverseWhereTheMatrixHasEntries) {
  const SelectedInverse::Matrix A = chain_with_loops(30);
  const Eigen::MatrixXd full = Eigen::MatrixXd(A).inverse();
  const auto inverse = SelectedInverse::of(A);
  ASSERT_TRUE(inverse);
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    for (SelectedInverse::Matrix::InnerIterator entry(A, j); entry; ++entry) {
      EXPECT_NEAR(inverse->at(entry.row(), j), full(entry.row(), j), 1e-12);
    }
  }
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(30, -1.0, 2.0);
  EXPECT_LT((inverse->times(b) - full * b).norm(), 1e-12);
}

TEST(SelectedInverse, IsNoneOfAMatrixThatIsNotPositiveDefinite) {
  SelectedInverse::Matrix A = chain_with_loops(10);
  A.coeffRef(3, 3) = -1.0;
  EXPECT_FALSE(SelectedInverse::of(A));
  A.coeffRef(3, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(SelectedInverse::of(A));
}

}  // namespace
}  // namespace oneac::internal
