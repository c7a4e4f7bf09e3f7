#include "oneac/calibration/turn_measurement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace oneac {
namespace {

constexpr double kBias = 0.004;  // [rad/s]
constexpr TurnSensor kGyroscope{0.001, 0.0, 0.02};

/// A drive round blocks: bends of 90° to either side with straights of 5 s between them.
std::vector<TurnSpan> blocks(int bends, double focal_too_long, double noise, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<TurnSpan> spans;
  for (int i = 0; i < bends; ++i) {
    for (const double turn : {0.0, i % 3 == 2 ? -1.57 : 1.57}) {
      const double seen = turn / (1.0 + focal_too_long) + noise * normal(random);
      spans.push_back({5.0, seen, turn + kBias * 5.0 + noise * normal(random)});
    }
  }
  return spans;
}

TEST(FocalByTurns, GyroscopeWithABiasTellsAFocalLengthThatIsTooLong) {
  const auto measured = measure_focal_by_turns(blocks(6, 0.05, 0.0, 1), kGyroscope);
  ASSERT_TRUE(measured);
  EXPECT_NEAR(measured->log_focal, -std::log(1.05), 1e-4);
  EXPECT_NEAR(measured->bias, kBias, 1e-4);
}

TEST(FocalByTurns, ErrorsAreWhatSigmaSays) {
  double squares = 0.0;
  constexpr int kDrives = 200;
  for (unsigned seed = 1; seed <= kDrives; ++seed) {
    const auto measured = measure_focal_by_turns(blocks(6, -0.03, 0.005, seed), kGyroscope);
    ASSERT_TRUE(measured);
    const double error = (measured->log_focal + std::log(0.97)) / measured->sigma;
    EXPECT_LT(std::abs(error), 5.0);
    squares += error * error;
  }
  const double rms = std::sqrt(squares / kDrives);
  EXPECT_LT(rms, 1.2);
  EXPECT_GT(rms, 0.5);
}

TEST(FocalByTurns, ScaleOfTheSensorIsPartOfSigma) {
  const auto measured = measure_focal_by_turns(blocks(20, 0.0, 0.001, 1), {0.001, 0.01, 0.02});
  ASSERT_TRUE(measured);
  EXPECT_GE(measured->sigma, 0.01);
}

TEST(FocalByTurns, ABendThatImagesLostIsWeighedDown) {
  std::vector<TurnSpan> spans = blocks(8, 0.05, 0.002, 3);
  spans[1].by_images *= 0.5;
  const auto measured = measure_focal_by_turns(spans, kGyroscope);
  ASSERT_TRUE(measured);
  EXPECT_LT(std::abs(measured->log_focal + std::log(1.05)), 2.0 * measured->sigma);
  EXPECT_LT(measured->sigma, 0.05);
}

TEST(FocalByTurns, OneBendOrAStraightRoadTellNothing) {
  EXPECT_FALSE(measure_focal_by_turns(blocks(1, 0.05, 0.001, 1), kGyroscope));
  EXPECT_FALSE(measure_focal_by_turns({}, kGyroscope));
  std::vector<TurnSpan> one = blocks(8, 0.05, 0.001, 1);
  for (std::size_t i = 3; i < one.size(); i += 2) one[i].by_images = one[i].by_sensor = 0.001;
  EXPECT_FALSE(measure_focal_by_turns(one, kGyroscope));
  std::vector<TurnSpan> straight(20, TurnSpan{5.0, 0.003, 0.02});
  EXPECT_FALSE(measure_focal_by_turns(straight, kGyroscope));
}

TEST(FocalByTurns, SensorThatTurnsTheOtherWayIsNoFocalLength) {
  std::vector<TurnSpan> spans = blocks(6, 0.0, 0.001, 1);
  for (TurnSpan& span : spans) span.by_sensor *= -1.0;
  EXPECT_FALSE(measure_focal_by_turns(spans, kGyroscope));
}

TEST(FocalByTurns, SensorsOutOfBoundsAreRefused) {
  EXPECT_THROW((void)measure_focal_by_turns({}, {0.0, 0.0, 0.0}), std::invalid_argument);
  EXPECT_THROW((void)measure_focal_by_turns({}, {0.1, NAN, 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
