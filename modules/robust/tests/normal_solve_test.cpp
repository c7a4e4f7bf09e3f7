#include "polish/normal_solve.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <random>

namespace oneac::internal {
namespace {

using Matrix5 = Eigen::Matrix<double, 5, 5>;
using Vector5 = Eigen::Matrix<double, 5, 1>;

/// Σ JᵀJ of a few random rows with columns of very different size.
Matrix5 random_normal_matrix(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Eigen::Matrix<double, 9, 5> J;
  for (int i = 0; i < J.size(); ++i) J(i) = normal(random);
  J.col(0) *= 1e3;
  J.col(4) *= 1e-3;
  return J.transpose() * J;
}

TEST(SolvePositive, SolvesWhatEigenSolves) {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const Matrix5 H = random_normal_matrix(random);
    const Vector5 b = Vector5::Random();
    Vector5 x;
    ASSERT_TRUE(solve_positive<5>(H, b, x)) << i;
    const Vector5 expected = H.llt().solve(b);
    EXPECT_LT((x - expected).norm(), 1e-9 * expected.norm()) << i;
  }
}

TEST(SolvePositive, RefusesWhatHasADirectionOfNoOrNegativeCurvature) {
  std::mt19937 random(4);
  Vector5 x;
  for (int k = 0; k < 5; ++k) {
    Matrix5 H = random_normal_matrix(random);
    H(k, k) = -1.0;
    EXPECT_FALSE(solve_positive<5>(H, Vector5::Ones(), x)) << k;
  }
  EXPECT_FALSE(solve_positive<5>(Matrix5::Zero(), Vector5::Ones(), x));
}

TEST(SolvePositive, RefusesWhatIsNotFinite) {
  Vector5 x;
  for (double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (int k = 0; k < 5; ++k) {
      Matrix5 H = Matrix5::Identity();
      H(4, k) = H(k, 4) = bad;
      EXPECT_FALSE(solve_positive<5>(H, Vector5::Ones(), x)) << bad << " " << k;
    }
  }
}

}  // namespace
}  // namespace oneac::internal
