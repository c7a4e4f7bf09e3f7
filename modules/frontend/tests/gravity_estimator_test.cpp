#include "attitude/gravity_estimator.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kGravity = 9.81;

double pitch_of(const Eigen::Vector3d& up) {
  return std::asin(up.x() / up.norm());
}
double roll_of(const Eigen::Vector3d& up) {
  return std::atan2(up.y(), up.z());
}

/// A minute in which a vehicle of given pitch and roll brakes, speeds up and turns left mostly.
GravityEstimator after_a_drive(double pitch, double roll, bool with_gyroscopes) {
  GravityEstimator gravity;
  SceneGenerator random(3);
  constexpr int kReadings = 6000;
  for (int i = 0; i < kReadings; ++i) {
    const double time = 0.01 * i;
    const double ahead = 1.5 * std::sin(0.4 * time);  // [m/s²]
    const double yaw_rate = std::fmod(time, 20.0) < 5.0 ? 0.35 : 0.0;
    const double speed = 7.0 + std::cos(0.7 * time);
    const Eigen::Vector3d force(kGravity * std::sin(pitch) + ahead + random.normal(0.1),
                                kGravity * std::sin(roll) + speed * yaw_rate + random.normal(0.1),
                                kGravity);
    gravity.add({time, force, with_gyroscopes ? std::optional(yaw_rate) : std::nullopt});
  }
  return gravity;
}

TEST(GravityEstimator, FindsTheTiltOfAVehicleThatTurnsAndBrakes) {
  const auto gravity = after_a_drive(-1.5 * kDegree, 2.0 * kDegree, true);
  ASSERT_TRUE(gravity.up().has_value());
  EXPECT_NEAR(pitch_of(*gravity.up()), -1.5 * kDegree, 0.3 * kDegree);
  EXPECT_NEAR(roll_of(*gravity.up()), 2.0 * kDegree, 0.1 * kDegree);
  EXPECT_LT(gravity.sigma(), 0.5 * kDegree);
}

TEST(GravityEstimator, LeansIntoTheTurnsWithoutGyroscopes) {
  const auto gravity = after_a_drive(0.0, 0.0, false);
  EXPECT_GT(roll_of(*gravity.up()), 2.0 * kDegree);  // what the yaw rate is good for
}

TEST(GravityEstimator, SaysNothingBeforeItHasSomeReadings) {
  GravityEstimator gravity;
  EXPECT_FALSE(gravity.up().has_value());
  EXPECT_TRUE(std::isinf(gravity.sigma()));
  for (int i = 0; i < 9; ++i) gravity.add({0.1 * i, {0.0, 0.0, kGravity}, std::nullopt});
  EXPECT_FALSE(gravity.up().has_value());
  gravity.add({1.0, {0.0, 0.0, kGravity}, std::nullopt});
  EXPECT_TRUE(gravity.up().has_value());
}

TEST(GravityEstimator, PassesOverNumbersThatAreNone) {
  GravityEstimator gravity;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 20; ++i) {
    gravity.add({0.1 * i, {nan, 0.0, kGravity}, 0.1});
    gravity.add({nan, {0.0, 0.0, kGravity}, 0.1});
    gravity.add({0.1 * i, {0.0, 0.0, 1.0}, nan});  // g, not m/s²: no accelerometer to rely on
  }
  EXPECT_FALSE(gravity.up().has_value());
  EXPECT_TRUE(std::isfinite(gravity.sigma()));
}

TEST(GravityEstimator, IsUncertainAfterAShortDrive) {
  GravityEstimator gravity;
  for (int i = 0; i < 20; ++i) gravity.add({0.1 * i, {1.5, 0.0, kGravity}, std::nullopt});
  EXPECT_GT(gravity.sigma(), 5.0 * kDegree);
}

}  // namespace
}  // namespace oneac
