#include "oneac/frontend/suspension_pitch.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kPeriod = 0.1;  // [s] between images
constexpr double kTurnNoise = 0.03 * kDegree;
constexpr double kTravelNoise = 0.4 * kDegree;

/// A drive as functions of time [s].
struct Drive {
  std::function<double(double)> pitch;  ///< [rad] of the body on its road
  std::function<double(double)> slope = [](double) { return 0.0; };  ///< [rad] of the road, rising
  double speed = 8.0;                                                ///< [m/s]
  double seconds = 6.0;
};

struct Errors {
  double rms = 0.0;          ///< [rad] of the filter
  double rms_of_zero = 0.0;  ///< [rad] of assuming that the springs are at rest
  double largest = 0.0;      ///< [rad]
  double normalised = 0.0;   ///< mean square of error over σ
};

Errors follow(const Drive& drive, SuspensionPitch& filter, unsigned seed) {
  SceneGenerator random(seed);
  Errors errors;
  const int steps = static_cast<int>(drive.seconds / kPeriod);
  for (int i = 1; i <= steps; ++i) {
    const double t = kPeriod * i, before = t - kPeriod;
    const double truth = drive.pitch(t);
    PitchStep step;
    const double turn = truth - drive.pitch(before) + drive.slope(t) - drive.slope(before);
    step.turn = {turn + random.normal(kTurnNoise), kTurnNoise};
    step.length = drive.speed * kPeriod;
    if (drive.speed > 0.0) {
      const double middle = 0.5 * (truth + drive.pitch(before));
      step.travel = {middle + random.normal(kTravelNoise), kTravelNoise};
    }
    filter.add_step(step);
    const double error = filter.pitch().angle - truth;
    errors.rms += error * error / steps;
    errors.rms_of_zero += truth * truth / steps;
    errors.largest = std::max(errors.largest, std::abs(error));
    errors.normalised += std::pow(error / filter.pitch().sigma, 2) / steps;
  }
  errors.rms = std::sqrt(errors.rms);
  errors.rms_of_zero = std::sqrt(errors.rms_of_zero);
  return errors;
}

/// 0 before `from`, 1 half a second later.
double ramp(double t, double from) {
  return std::min(std::max((t - from) / 0.5, 0.0), 1.0);
}

TEST(SuspensionPitch, FollowsTheDiveOfABrakingCar) {
  SuspensionPitch filter({0.0, 0.1 * kDegree});
  Drive brakes{[](double t) { return -1.5 * kDegree * (ramp(t, 2.0) - ramp(t, 4.0)); }};
  const Errors errors = follow(brakes, filter, 1);
  EXPECT_LT(errors.rms, 0.3 * errors.rms_of_zero);
  EXPECT_LT(errors.largest, 0.6 * kDegree);
}

TEST(SuspensionPitch, FollowsADampedBounce) {
  SuspensionPitch filter({0.0, 0.1 * kDegree});
  Drive bounces{
      [](double t) { return 2.0 * kDegree * std::exp(-t / 2.0) * std::sin(2.0 * M_PI * 1.5 * t); }};
  const Errors errors = follow(bounces, filter, 2);
  EXPECT_LT(errors.rms, 0.5 * errors.rms_of_zero);
}

TEST(SuspensionPitch, LearnsThatASlopeIsNoPitch) {
  SuspensionPitch filter({0.0, 0.1 * kDegree});
  Drive climbs{[](double) { return 0.0; },
               [](double t) { return 1.7 * kDegree * ramp(t, 1.0); }};  // 3 % after 4 m
  EXPECT_LT(follow(climbs, filter, 3).largest, 1.5 * kDegree);
  EXPECT_NEAR(filter.pitch().angle, 0.0, 0.3 * kDegree);
}

TEST(SuspensionPitch, RocksOnWhenTheCarHasStopped) {
  SuspensionPitch filter({0.0, 0.1 * kDegree});
  Drive brakes{[](double t) { return -1.0 * kDegree * ramp(t, 2.0); }};
  (void)follow(brakes, filter, 5);
  Drive stands{[](double t) { return -1.0 * kDegree * (1.0 - ramp(t, 0.2)); }};
  stands.speed = 0.0;
  stands.seconds = 1.0;
  const double before = filter.pitch().sigma;
  EXPECT_LT(follow(stands, filter, 6).largest, 0.5 * kDegree);
  EXPECT_NEAR(filter.pitch().angle, 0.0, 0.5 * kDegree);
  EXPECT_LT(filter.pitch().sigma, std::hypot(before, 0.15 * kDegree)) << "the road did not change";
}

TEST(SuspensionPitch, FindsAMountingThatIsGivenWrong) {
  SuspensionPitch filter({8.2 * kDegree, 1.0 * kDegree});
  Drive drive{[](double) { return 6.9 * kDegree; }};
  drive.seconds = 1.0;
  (void)follow(drive, filter, 7);
  EXPECT_NEAR(filter.pitch().angle, 6.9 * kDegree, 0.4 * kDegree);
}

TEST(SuspensionPitch, IsSureOfItselfAsFarAsItIsRight) {
  double normalised = 0.0;
  constexpr int kDrives = 20;
  for (unsigned seed = 0; seed < kDrives; ++seed) {
    SuspensionPitch filter({0.0, 0.1 * kDegree});
    // A slope that wanders as the filter assumes, in steps of 0.8 m.
    SceneGenerator random(100 + seed);
    std::vector<double> slope(70, 0.0);
    for (std::size_t i = 1; i < slope.size(); ++i) {
      slope[i] = slope[i - 1] + random.normal(0.1 * kDegree * std::sqrt(0.8));
    }
    const auto slope_at = [&](double t) {
      return slope[static_cast<std::size_t>(std::lround(t / kPeriod))];
    };
    Drive drive{[](double t) { return 0.5 * kDegree * std::sin(2.0 * M_PI * 0.5 * t); }, slope_at};
    normalised += follow(drive, filter, seed).normalised / kDrives;
  }
  EXPECT_GT(normalised, 0.6);
  EXPECT_LT(normalised, 1.4);
}

TEST(SuspensionPitch, TakesTheDirectionOfTravelForTheMiddleOfTheStep) {
  SuspensionPitch filter({0.0, 10.0 * kDegree});
  PitchStep step;
  step.turn = {2.0 * kDegree, kTurnNoise};
  step.length = 0.8;
  step.travel = AngleBelief{1.0 * kDegree, 0.1 * kDegree};  // from 0° to 2°
  filter.add_step(step);
  EXPECT_NEAR(filter.pitch().angle, 2.0 * kDegree, 0.1 * kDegree);
}

TEST(SuspensionPitch, GivesWayToNoBump) {
  SuspensionPitch filter({0.0, 0.1 * kDegree});
  Drive drive{[](double) { return 0.0; }};
  (void)follow(drive, filter, 8);
  const double before = filter.pitch().angle;
  PitchStep bump;
  bump.turn = {0.0, kTurnNoise};
  bump.length = 0.8;
  bump.travel = AngleBelief{10.0 * kDegree, kTravelNoise};
  filter.add_step(bump);
  EXPECT_LT(filter.pitch().angle - before, 0.5 * kDegree);
}

TEST(SuspensionPitch, IsAtRestAgainAfterAStepThatNobodySaw) {
  SuspensionPitch filter({2.0 * kDegree, 0.1 * kDegree});
  Drive brakes{[](double t) { return 2.0 * kDegree - 1.5 * kDegree * ramp(t, 2.0); }};
  (void)follow(brakes, filter, 9);
  filter.lose({2.0 * kDegree, 0.1 * kDegree});
  EXPECT_EQ(filter.pitch().angle, 2.0 * kDegree);
  EXPECT_GT(filter.pitch().sigma, 0.9 * kDegree);
}

TEST(SuspensionPitch, PassesOverMeasurementsThatAreNone) {
  SuspensionPitch filter({0.0, 0.1 * kDegree});
  const AngleBelief before = filter.pitch();
  filter.add_measurement({1.0, HUGE_VAL});
  filter.add_measurement({1.0, 0.0});
  EXPECT_EQ(filter.pitch().angle, before.angle);
  EXPECT_EQ(filter.pitch().sigma, before.sigma);
}

}  // namespace
}  // namespace oneac
