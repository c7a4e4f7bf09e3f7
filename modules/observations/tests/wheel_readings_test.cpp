#include "oneac/observations/wheel_readings.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace oneac {
namespace {

using mrpt::obs::CObservationOdometry;

CObservationOdometry observation(double time_s, double x, double y = 0.0) {
  CObservationOdometry wheels;
  wheels.sensorLabel = "WHEELS";
  wheels.timestamp = mrpt::Clock::fromDouble(time_s);
  wheels.odometry = mrpt::poses::CPose2D(x, y, 0.0);
  return wheels;
}

/// What 20 Hz of positions tell over some seconds.
std::vector<SpeedReading> told(const std::function<double(double)>& x_at, double seconds = 4.0) {
  WheelSpeeds speeds;
  std::vector<SpeedReading> all;
  for (int i = 0; i <= std::lround(seconds * 20.0); ++i) {
    const double t = 0.05 * i;
    if (const auto one = speeds.add({t, {x_at(t), 1.0}, std::nullopt})) all.push_back(*one);
  }
  return all;
}

TEST(WheelReading, HasThePositionAndTheSpeedThatAreStated) {
  CObservationOdometry wheels = observation(5.0, 3.0, 4.0);
  const auto place = wheel_reading(wheels);
  ASSERT_TRUE(place.has_value());
  EXPECT_EQ(place->position, Eigen::Vector2d(3.0, 4.0));
  EXPECT_FALSE(place->speed.has_value());
  wheels.hasVelocities = true;
  wheels.velocityLocal.vx = -6.0;
  wheels.velocityLocal.vy = 0.0;
  const auto moving = wheel_reading(wheels);
  ASSERT_TRUE(moving && moving->speed);
  EXPECT_EQ(*moving->speed, 6.0) << "backwards is a way, too";
}

TEST(WheelReading, IsNoneOfWhatIsDamaged) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(wheel_reading(observation(1.0, nan)).has_value());
  EXPECT_FALSE(wheel_reading(observation(1.0, HUGE_VAL)).has_value());
  CObservationOdometry wheels = observation(1.0, 0.0);
  wheels.hasVelocities = true;
  for (const double speed : {nan, HUGE_VAL, 1e9}) {
    wheels.velocityLocal.vx = speed;
    EXPECT_FALSE(wheel_reading(wheels).has_value()) << speed;
  }
  wheels.hasVelocities = false;
  wheels.timestamp = INVALID_TIMESTAMP;
  EXPECT_FALSE(wheel_reading(wheels).has_value());
}

TEST(WheelSpeeds, AreThoseOfTheWayWithTheSlipOfTyres) {
  const auto speeds = told([](double t) { return 8.0 * t; });
  ASSERT_GT(speeds.size(), 10U);
  for (const SpeedReading& one : speeds) {
    EXPECT_NEAR(one.speed, 8.0, 1e-9);
    EXPECT_GT(one.sigma, WheelSpeeds::kSlip * 8.0);
    EXPECT_LT(one.sigma, 0.05 * 8.0);
  }
}

TEST(WheelSpeeds, HoldForTheMiddleOfTheirStretch) {
  for (const SpeedReading& one : told([](double t) { return t * t; })) {
    EXPECT_NEAR(one.speed, 2.0 * one.time_s, 1e-9);
  }
}

TEST(WheelSpeeds, LeaveOutACounterThatJumpsOrIsSetBack) {
  for (const double jump : {7.0, -20.0}) {
    for (const double when : {0.11, 2.01}) {  // in the first stretch, too
      const auto speeds = told([&](double t) { return 8.0 * t + (t > when ? jump : 0.0); }, 8.0);
      ASSERT_GT(speeds.size(), 15U);
      for (const SpeedReading& one : speeds) EXPECT_NEAR(one.speed, 8.0, 1e-9);
    }
  }
}

TEST(WheelSpeeds, AreNoneOfACounterThatJumpsAgainAndAgain) {
  EXPECT_TRUE(told([](double t) { return 8.0 * t + 2.0 * std::floor(3.0 * t); }, 8.0).empty());
}

TEST(WheelSpeeds, AreThoseThatAreStated) {
  WheelSpeeds speeds;
  std::size_t count = 0;
  for (int i = 0; i < 60; ++i) {
    const double speed = 5.0 + 0.001 * (i % 7);
    const auto one = speeds.add({0.05 * i, Eigen::Vector2d::Zero(), speed});
    if (!one) continue;
    ++count;
    EXPECT_NEAR(one->speed, 5.0, 0.01) << "positions that stay are not asked";
  }
  EXPECT_GT(count, 5U);
}

TEST(WheelSpeeds, AreNoneOfASensorThatFroze) {
  WheelSpeeds speeds;
  double latest = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double t = 0.05 * i;
    const double speed = t < 3.0 ? 5.0 + 0.001 * i : 5.3;
    if (const auto one = speeds.add({t, Eigen::Vector2d::Zero(), speed})) latest = one->time_s;
  }
  EXPECT_GT(latest, 2.5);
  EXPECT_LT(latest, 4.1);
}

TEST(WheelSpeeds, KnowNothingOfAGapAndOfTimesThatGoBack) {
  WheelSpeeds speeds;
  for (int i = 0; i < 50; ++i) {
    EXPECT_FALSE(speeds.add({1.5 * i, {12.0 * i, 0.0}, std::nullopt}).has_value());
  }
  const auto back = [&speeds](int i) { return speeds.add({70.0 - i, {8.0 * i, 0.0}, {}}); };
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(back(i).has_value());
}

TEST(WheelFollower, StaysWithTheFirstOdometer) {
  WheelFollower follower;
  using Use = WheelFollower::Use;
  CObservationOdometry damaged = observation(0.0, std::nan(""));
  damaged.sensorLabel = "BROKEN";
  EXPECT_EQ(follower.take(damaged).use, Use::kUnusable);
  EXPECT_EQ(follower.take(observation(0.0, 0.0)).use, Use::kTaken);
  CObservationOdometry other = observation(0.1, 100.0);
  other.sensorLabel = "OTHER";
  EXPECT_EQ(follower.take(other).use, Use::kOtherSensor);
}

}  // namespace
}  // namespace oneac
