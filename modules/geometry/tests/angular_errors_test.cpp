#include "oneac/geometry/angular_errors.h"

#include "oneac/geometry/relative_pose.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace oneac {
namespace {

constexpr double kPi = 3.14159265358979323846;
const Eigen::Matrix3d kIdentity = Eigen::Matrix3d::Identity();

Eigen::Vector3d turned(double angle) {
  return {std::sin(angle), 0.0, std::cos(angle)};
}

TEST(RotationError, IsTheAngleBetweenTheRotationsWhateverTheirOrientation) {
  SceneGenerator scenes(1);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Matrix3d R_ref = scenes.general_motion().R;
    const double angle = scenes.uniform(0.0, kPi);
    const Eigen::Vector3d axis = scenes.general_motion().t.normalized();
    const Eigen::Matrix3d R_est = rotation_from_vector(angle * axis) * R_ref;
    EXPECT_NEAR(rotation_error(R_est, R_ref), angle, 1e-12) << "seed 1, scene " << i;
    EXPECT_NEAR(rotation_error(R_ref, R_est), angle, 1e-12) << "seed 1, scene " << i;
  }
}

TEST(RotationError, KeepsItsDigitsNearZero) {
  for (double angle : {1e-4, 1e-7, 1e-10, 1e-13}) {
    const Eigen::Matrix3d R = rotation_from_vector(angle * Eigen::Vector3d(1, 2, 2) / 3);
    EXPECT_NEAR(rotation_error(R, kIdentity) / angle, 1.0, 1e-9) << angle;
  }
  EXPECT_EQ(rotation_error(kIdentity, kIdentity), 0.0);
}

TEST(RotationError, KeepsItsDigitsNearHalfATurn) {
  for (double rest : {0.0, 1e-10, 1e-7, 1e-4}) {
    const Eigen::Matrix3d R = rotation_from_vector((kPi - rest) * Eigen::Vector3d(1, 2, 2) / 3);
    EXPECT_NEAR(rotation_error(R, kIdentity), kPi - rest, 1e-14) << rest;
  }
}

TEST(DirectionError, IsTheAngleWhateverTheLengths) {
  EXPECT_NEAR(direction_error(5.0 * turned(0.3), 0.01 * turned(0.1)), 0.2, 1e-14);
}

TEST(DirectionError, CountsTheSign) {
  EXPECT_NEAR(direction_error(turned(0.3), -turned(0.3)), kPi, 1e-14);
  EXPECT_NEAR(direction_error(turned(0.0), -turned(0.2)), kPi - 0.2, 1e-14);
}

TEST(DirectionError, KeepsItsDigitsNearZero) {
  EXPECT_NEAR(direction_error(turned(1e-10), turned(0.0)) / 1e-10, 1.0, 1e-9);
}

TEST(DirectionError, IsARightAngleWithoutADirection) {
  EXPECT_DOUBLE_EQ(direction_error(Eigen::Vector3d::Zero(), turned(0)), kPi / 2);
  EXPECT_DOUBLE_EQ(direction_error(turned(0), Eigen::Vector3d::Zero()), kPi / 2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_DOUBLE_EQ(direction_error({nan, 0, 1}, turned(0)), kPi / 2);
}

TEST(NormalError, IgnoresTheSign) {
  EXPECT_NEAR(normal_error(turned(0.3), turned(0.1)), 0.2, 1e-14);
  EXPECT_NEAR(normal_error(turned(0.3), -turned(0.1)), 0.2, 1e-14);
  EXPECT_NEAR(normal_error(-turned(0.3), turned(0.1)), 0.2, 1e-14);
}

TEST(NormalError, IsAtMostARightAngle) {
  EXPECT_NEAR(normal_error(turned(0.0), turned(0.5 * kPi + 0.1)), 0.5 * kPi - 0.1, 1e-14);
}

}  // namespace
}  // namespace oneac
