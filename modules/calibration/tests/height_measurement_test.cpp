#include "oneac/calibration/height_measurement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace oneac {
namespace {

/// Ways of 16 m, seen by a camera that is `ratio` times as high as was assumed.
std::vector<WaySpan> ways(int count, double ratio, double noise_m, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<WaySpan> spans;
  for (int i = 0; i < count; ++i) {
    const double way = 12.0 + i % 5;
    spans.push_back({way / ratio, way + noise_m * normal(random), 0.1});
  }
  return spans;
}

TEST(HeightByWays, ACameraThatIsHigherThanAssumedIsFound) {
  const auto measured = measure_height_by_ways(ways(5, 1.2, 0.0, 1));
  ASSERT_TRUE(measured);
  EXPECT_NEAR(measured->ratio, 1.2, 1e-9);
  EXPECT_GT(measured->sigma, 0.0);
  EXPECT_EQ(measured->spans, 5U);
}

TEST(HeightByWays, ErrorsAreWhatSigmaSays) {
  // Also where the sensor is four times as bad as it says.
  for (const double noise : {0.1, 0.4}) {
    double squares = 0.0;
    constexpr int kDrives = 200;
    for (unsigned seed = 1; seed <= kDrives; ++seed) {
      const auto measured = measure_height_by_ways(ways(8, 0.9, noise, seed));
      ASSERT_TRUE(measured);
      const double error = std::log(measured->ratio / 0.9) / measured->sigma;
      EXPECT_LT(std::abs(error), 6.0) << "seed " << seed;
      squares += error * error;
    }
    const double rms = std::sqrt(squares / kDrives);
    EXPECT_LT(rms, 1.2) << noise;
    EXPECT_GT(rms, 0.5) << noise;
  }
}

TEST(HeightByWays, AStretchThatASensorLostIsWeighedDown) {
  std::vector<WaySpan> spans = ways(12, 1.1, 0.05, 3);
  spans[2].by_sensor = 2.0;
  const auto measured = measure_height_by_ways(spans);
  ASSERT_TRUE(measured);
  EXPECT_NEAR(measured->ratio, 1.1, 0.02);
}

TEST(HeightByWays, TwoOfThreeThatAgreeByChanceDoNotOutvoteTheThird) {
  // A receiver that filters: too far where the vehicle brakes, too short where it speeds up.
  const auto measured =
      measure_height_by_ways({{14.95, 16.28, 0.32}, {13.23, 14.48, 0.19}, {15.22, 14.91, 0.33}});
  ASSERT_TRUE(measured);
  EXPECT_GT(measured->sigma, 0.03);
  EXPECT_LT(std::log(measured->ratio / 1.02), 2.0 * measured->sigma);
}

TEST(HeightByWays, ErrorsThatLastWidenSigma) {
  std::vector<WaySpan> spans = ways(6, 1.0, 0.0, 1), alternating = spans;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    spans[i].by_sensor += i / 3 % 2 == 0 ? 0.5 : -0.5;
    alternating[i].by_sensor += i % 2 == 0 ? 0.5 : -0.5;
  }
  const auto lasting = measure_height_by_ways(spans);
  const auto brief = measure_height_by_ways(alternating);
  ASSERT_TRUE(lasting && brief);
  EXPECT_GT(lasting->sigma, 1.1 * brief->sigma);
}

TEST(HeightByWays, TooLittleWayTellsNothing) {
  EXPECT_FALSE(measure_height_by_ways({}));
  EXPECT_FALSE(measure_height_by_ways(ways(2, 1.0, 0.0, 1)));
  EXPECT_FALSE(measure_height_by_ways({{1.0, 1.0, 0.1}, {1.0, 1.0, 0.1}, {1.0, 1.0, 0.1}}));
  EXPECT_FALSE(measure_height_by_ways({{0.0, 9.0, 0.1}, {0.0, 9.0, 0.1}, {0.0, 9.0, 0.1}}))
      << "a road that told no way";
}

TEST(HeightByWays, RefusesWhatIsNoWay) {
  std::vector<WaySpan> spans = ways(4, 1.0, 0.0, 1);
  spans[0].sigma = 0.0;
  EXPECT_THROW(static_cast<void>(measure_height_by_ways(spans)), std::invalid_argument);
  spans[0] = {std::numeric_limits<double>::quiet_NaN(), 1.0, 0.1};
  EXPECT_THROW(static_cast<void>(measure_height_by_ways(spans)), std::invalid_argument);
}

TEST(HeightByAll, SensorsThatAgreeAreWeighedAndThoseThatDoNotTellNothing) {
  const auto both = height_by_all({{1.00, 0.01, 100.0, 8}, {1.02, 0.02, 90.0, 7}});
  ASSERT_TRUE(both);
  EXPECT_NEAR(both->ratio, 1.004, 1e-3);
  EXPECT_NEAR(both->sigma, 0.0089, 1e-4);
  EXPECT_FALSE(height_by_all({{1.0, 0.01, 100.0, 8}, {1.2, 0.02, 90.0, 7}}));
  EXPECT_FALSE(height_by_all({}));
}

}  // namespace
}  // namespace oneac
