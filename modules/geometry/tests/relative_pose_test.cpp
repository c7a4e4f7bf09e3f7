#include "oneac/geometry/relative_pose.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace oneac {
namespace {

const Eigen::Vector3d kX1(0.3, -1.2, 7.0);

void expect_rotation(const Eigen::Matrix3d& R) {
  EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-13);
  EXPECT_NEAR(R.determinant(), 1.0, 1e-13);
}

TEST(RelativePose, MapsPointsFromTheFirstCameraToTheSecond) {
  // The camera drives 1 m forward: what was 7 m ahead is 6 m ahead.
  const RelativePose forward{Eigen::Matrix3d::Identity(), {0, 0, -1}};
  EXPECT_TRUE((forward * kX1).isApprox(Eigen::Vector3d(0.3, -1.2, 6.0)));
}

TEST(RelativePose, ComposesFromRightToLeft) {
  SceneGenerator scenes(25);
  for (int i = 0; i < 1000; ++i) {
    const RelativePose T_2_1 = scenes.general_motion();
    const RelativePose T_3_2 = scenes.general_motion();
    const Eigen::Vector3d X3 = T_3_2 * (T_2_1 * kX1);
    EXPECT_LT(((T_3_2 * T_2_1) * kX1 - X3).norm(), 1e-12) << "seed 25, scene " << i;
  }
}

TEST(RelativePose, InverseMapsBack) {
  SceneGenerator scenes(26);
  for (int i = 0; i < 1000; ++i) {
    const RelativePose T = scenes.general_motion();
    EXPECT_LT((T.inverse() * (T * kX1) - kX1).norm(), 1e-12) << "seed 26, scene " << i;
    EXPECT_LT((T * (T.inverse() * kX1) - kX1).norm(), 1e-12) << "seed 26, scene " << i;
  }
}

TEST(RelativePose, IsIdentityUnlessSet) {
  EXPECT_EQ(RelativePose() * kX1, kX1);
}

TEST(RelativePose, KnowsWhetherItIsFinite) {
  RelativePose T;
  EXPECT_TRUE(T.is_finite());
  T.t.x() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(T.is_finite());
  T = {};
  T.R(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(T.is_finite());
}

TEST(YawRotation, HasTheRowsOfEquationTwo) {
  const Eigen::Matrix3d R = yaw_rotation(0.8, 0.6);
  Eigen::Matrix3d expected;
  expected << 0.8, 0, -0.6, 0, 1, 0, 0.6, 0, 0.8;
  EXPECT_EQ(R, expected);
  expect_rotation(R);
}

TEST(YawRotation, OfAPositiveAngleIsACameraThatTurnsRight) {
  // What was straight ahead moves to the left of the image.
  const Eigen::Vector3d ahead =
      yaw_rotation(std::cos(0.1), std::sin(0.1)) * Eigen::Vector3d(0, 0, 1);
  EXPECT_LT(ahead.x(), 0.0);
}

TEST(YawRotation, IsTheRightHandedRotationByTheNegativeAngleAboutY) {
  const Eigen::Matrix3d R = yaw_rotation(std::cos(0.3), std::sin(0.3));
  EXPECT_TRUE(R.isApprox(rotation_from_vector({0, -0.3, 0}), 1e-14));
}

TEST(RotationFromVector, IsTheAngleAboutTheAxisAtEverySize) {
  const Eigen::Vector3d axis = Eigen::Vector3d(2, -3, 6) / 7.0;
  for (double angle : {1e-12, 1e-6, 1e-3, 0.02, 0.0999999, 0.1000001, 0.3, 3.0}) {
    const Eigen::Matrix3d R = rotation_from_vector(angle * axis);
    const Eigen::Matrix3d expected = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    EXPECT_LT((R - expected).norm(), 1e-15) << angle;
    EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 2e-15) << angle;
  }
  EXPECT_EQ(rotation_from_vector({0, 0, 0}), Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
}

TEST(PitchRotation, TurnsYTowardsZ) {
  const Eigen::Matrix3d R = pitch_rotation(0.3);
  expect_rotation(R);
  EXPECT_TRUE((R * Eigen::Vector3d::UnitY())
                  .isApprox(Eigen::Vector3d(0, std::cos(0.3), std::sin(0.3)), 1e-14));
}

TEST(RollRotation, TurnsXTowardsY) {
  const Eigen::Matrix3d R = roll_rotation(0.3);
  expect_rotation(R);
  EXPECT_TRUE((R * Eigen::Vector3d::UnitX())
                  .isApprox(Eigen::Vector3d(std::cos(0.3), std::sin(0.3), 0), 1e-14));
}

TEST(CrossMatrix, MultipliesLikeTheCrossProduct) {
  const Eigen::Vector3d v(1, -2, 3), w(-4, 5, 0.5);
  EXPECT_TRUE((cross_matrix(v) * w).isApprox(v.cross(w), 1e-14));
  EXPECT_TRUE((cross_matrix(v) + cross_matrix(v).transpose()).isZero());
}

TEST(RotationFromVector, TurnsAboutItsVectorByItsLength) {
  const Eigen::Vector3d w = 0.7 * Eigen::Vector3d(1, 2, 2) / 3;
  const Eigen::Matrix3d R = rotation_from_vector(w);
  expect_rotation(R);
  EXPECT_TRUE((R * w).isApprox(w, 1e-14));
  EXPECT_NEAR(std::acos(0.5 * (R.trace() - 1)), 0.7, 1e-12);
  const Eigen::Matrix3d quarter = rotation_from_vector({0, 0, std::acos(0.0)});
  EXPECT_TRUE((quarter * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-14));
}

TEST(RotationFromVector, IsTheCrossMatrixToFirstOrderAndIdentityAtZero) {
  EXPECT_EQ(rotation_from_vector(Eigen::Vector3d::Zero()), Eigen::Matrix3d::Identity());
  const Eigen::Vector3d w(1e-9, -2e-9, 3e-9);
  const Eigen::Matrix3d first_order = Eigen::Matrix3d::Identity() + cross_matrix(w);
  EXPECT_LT((rotation_from_vector(w) - first_order).norm(), 1e-15);
}

}  // namespace
}  // namespace oneac
