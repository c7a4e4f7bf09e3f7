#include "run/gyroscope_check.h"

#include "turning_vehicle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac::app {
namespace {

constexpr double kStart = 1.26e9;

/// [rad] to the left and to the right in turn, 45° within two seconds.
double heading(double t) {
  return M_PI / 8.0 * (1.0 - std::cos(M_PI * t / 2.0));
}

Trajectory vehicle() {
  return turning_vehicle(kStart, heading);
}

/// @param axis  of the sensor that points up, so many times as fast as it should say
std::vector<ImuSample> imu(int axis, double times, double late_s = 0.0) {
  std::vector<ImuSample> samples;
  for (int i = 0; i < 3000; ++i) {
    const double t = 0.01 * i - late_s;
    ImuSample& sample = samples.emplace_back();
    sample.time_s = kStart + 0.01 * i;
    Eigen::Vector3d rate(0.02 * std::sin(3.0 * t), 0.01, 0.02 * std::cos(5.0 * t));
    rate[axis] = times * M_PI * M_PI / 16.0 * std::sin(M_PI * t / 2.0) + 0.01;
    sample.angular_rate = rate;
  }
  return samples;
}

std::optional<GyroscopeFault> fault(const std::vector<ImuSample>& samples) {
  return fault_of_gyroscope(vehicle(), std::vector<bool>(300, true), samples);
}

TEST(GyroscopeCheck, SaysNothingOfOneThatTurnsWithTheImages) {
  for (const double times : {0.7, 0.95, 1.0, 1.05, 1.5}) EXPECT_FALSE(fault(imu(2, times)));
  EXPECT_FALSE(fault(imu(2, 1.0, 0.2)));
}

TEST(GyroscopeCheck, NamesUnitAxisAndSign) {
  const auto degrees = fault(imu(2, 180.0 / M_PI));
  ASSERT_TRUE(degrees);
  EXPECT_EQ(degrees->axis, 2);
  EXPECT_NE(about_gyroscope(*degrees).find("about its +Z axis in deg/s;"), std::string::npos)
      << about_gyroscope(*degrees);
  const auto sideways = fault(imu(0, 1.0));
  ASSERT_TRUE(sideways);
  EXPECT_NE(about_gyroscope(*sideways).find("about its +X axis;"), std::string::npos);
  const auto down = fault(imu(2, -1.0));
  ASSERT_TRUE(down);
  EXPECT_NE(about_gyroscope(*down).find("about its -Z axis;"), std::string::npos);
  const auto both = fault(imu(1, -180.0 / M_PI));
  ASSERT_TRUE(both);
  EXPECT_NE(about_gyroscope(*both).find("about its -Y axis in deg/s;"), std::string::npos);
  const auto twice = fault(imu(2, M_PI / 180.0));
  ASSERT_TRUE(twice);
  EXPECT_NE(about_gyroscope(*twice).find("once too often"), std::string::npos)
      << about_gyroscope(*twice);
  const auto counts = fault(imu(2, 16.4));
  ASSERT_TRUE(counts);
  EXPECT_NE(about_gyroscope(*counts).find("16 times as much"), std::string::npos)
      << about_gyroscope(*counts);
}

TEST(GyroscopeCheck, SaysThatNoAxisTurnsWithTheImages) {
  const auto silent = fault(imu(2, 0.0));
  ASSERT_TRUE(silent);
  EXPECT_EQ(silent->axis, -1);
  EXPECT_NE(about_gyroscope(*silent).find("no axis of it does"), std::string::npos);
}

TEST(GyroscopeCheck, SaysNothingWhereNothingTells) {
  EXPECT_FALSE(fault({}));
  Trajectory straight = vehicle();
  for (auto& pose : straight.poses) pose.linear().setIdentity();
  const std::vector<ImuSample> wrong = imu(2, 57.3);
  EXPECT_FALSE(fault_of_gyroscope(straight, std::vector<bool>(300, true), wrong));
  EXPECT_FALSE(fault_of_gyroscope(vehicle(), std::vector<bool>(300, false), wrong));
  EXPECT_FALSE(fault_of_gyroscope({}, {}, wrong));
}

}  // namespace
}  // namespace oneac::app
