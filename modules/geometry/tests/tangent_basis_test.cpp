#include "oneac/geometry/tangent_basis.h"

#include <gtest/gtest.h>

#include <random>

namespace oneac {
namespace {

TEST(TangentBasis, IsOrthonormalAndPerpendicularToTheVector) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d t = Eigen::Vector3d(normal(random), normal(random), normal(random));
    const Eigen::Vector3d unit = t.normalized();
    const Eigen::Matrix<double, 3, 2> T = tangent_basis(unit);
    EXPECT_LT((T.transpose() * T - Eigen::Matrix2d::Identity()).norm(), 1e-14) << "vector " << i;
    EXPECT_LT((T.transpose() * unit).norm(), 1e-15) << "vector " << i;
  }
}

TEST(TangentBasis, IsThereAlongEachAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Matrix<double, 3, 2> T = tangent_basis(Eigen::Vector3d::Unit(axis));
    EXPECT_LT((T.transpose() * T - Eigen::Matrix2d::Identity()).norm(), 1e-15) << "axis " << axis;
    EXPECT_EQ(T.row(axis).norm(), 0.0) << "axis " << axis;
  }
}

}  // namespace
}  // namespace oneac
