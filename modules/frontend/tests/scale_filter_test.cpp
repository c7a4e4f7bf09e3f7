#include "oneac/frontend/scale_filter.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

TEST(ScaleFilter, IsNotMetricBeforeTheFirstMeasurement) {
  ScaleFilter filter{ScaleOptions{}};
  filter.drift();
  EXPECT_FALSE(filter.is_metric());
  EXPECT_TRUE(std::isinf(filter.uncertainty()));
}

TEST(ScaleFilter, TakesTheFirstMeasurementWhole) {
  ScaleFilter filter{ScaleOptions{}};
  EXPECT_DOUBLE_EQ(filter.correct(1.7, 0.04), 1.7);
  EXPECT_DOUBLE_EQ(filter.uncertainty(), 0.04);
  EXPECT_TRUE(filter.is_metric());
}

TEST(ScaleFilter, AveragesNoisyMeasurementsOfADriftingMap) {
  ScaleOptions options;
  ScaleFilter filter(options);
  SceneGenerator random(5);
  double truth_over_map = 2.0;
  double squares = 0.0;
  constexpr int kKeyframes = 400;
  for (int i = 0; i < kKeyframes; ++i) {
    truth_over_map *= std::exp(random.normal(options.map_drift));
    filter.drift();
    truth_over_map /= filter.correct(truth_over_map * std::exp(random.normal(0.04)), 0.04);
    if (i > 50) squares += std::pow(std::log(truth_over_map), 2);
  }
  const double rms = std::sqrt(squares / (kKeyframes - 51));
  EXPECT_LT(rms, 0.7 * 0.04);  // the drift alone allows half of one measurement's error
  EXPECT_NEAR(rms, filter.uncertainty(), 0.5 * filter.uncertainty());
}

TEST(ScaleFilter, KeepsTheMapsScaleAgainstASingleOutlier) {
  ScaleFilter filter{ScaleOptions{}};
  static_cast<void>(filter.correct(1.0, 0.02));
  EXPECT_DOUBLE_EQ(filter.correct(1.8, 0.03), 1.0);
  EXPECT_NEAR(filter.correct(1.02, 0.03), 1.0, 0.02);
}

TEST(ScaleFilter, BelievesWhatIsSaidAgainAndAgain) {
  ScaleFilter filter{ScaleOptions{}};
  static_cast<void>(filter.correct(1.0, 0.02));
  double factor = 1.0;
  for (int i = 0; i < 5; ++i) factor *= filter.correct(1.8, 0.03);
  EXPECT_NEAR(factor, 1.8, 1e-12);
}

TEST(ScaleFilter, GrowsUncertainWithoutMeasurements) {
  ScaleFilter filter{ScaleOptions{}};
  static_cast<void>(filter.correct(1.0, 0.02));
  for (int i = 0; i < 200; ++i) filter.drift();
  EXPECT_FALSE(filter.is_metric());
}

TEST(ScaleFilter, SaysHowFarMeasurementsSpeakForTheScaleBefore) {
  ScaleOptions options;
  ScaleFilter filter(options);
  EXPECT_EQ(filter.drift(), 1.0);  // nothing known: the first measurement is for all
  static_cast<void>(filter.correct(1.0, options.map_drift));
  EXPECT_NEAR(filter.drift(), 0.5, 1e-12);
  EXPECT_NEAR(filter.drift(), 2.0 / 3.0, 1e-12);
}

TEST(ScaleFilter, IgnoresNumbersThatAreNone) {
  ScaleFilter filter{ScaleOptions{}};
  for (const double ratio : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_EQ(filter.correct(ratio, 0.1), 1.0);
  }
  EXPECT_FALSE(filter.is_metric());
}

}  // namespace
}  // namespace oneac
