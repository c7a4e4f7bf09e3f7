#include "oneac/frontend/scale_filter.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

TEST(ScaleFilter, IsNotMetricBeforeTheFirstMeasurement) {
  ScaleFilter filter{ScaleOptions{}};
  filter.drift(1.0, 0.0);
  EXPECT_FALSE(filter.is_metric());
  EXPECT_TRUE(std::isinf(filter.uncertainty()));
}

TEST(ScaleFilter, TakesTheFirstMeasurementWhole) {
  ScaleFilter filter{ScaleOptions{}};
  EXPECT_DOUBLE_EQ(filter.correct(1.7, 0.04), 1.7);
  EXPECT_DOUBLE_EQ(filter.uncertainty(), std::hypot(0.04, ScaleOptions{}.road_uncertainty));
  EXPECT_TRUE(filter.is_metric());
}

/// How wrong a map is whose scale drifts, and how wrong it thinks it is.
struct Follow {
  double rms = 0.0;
  double uncertainty = 0.0;
};

/// @param bumps  1σ of the road's error, which lasts for some 5 m; keyframes are 1.4 m apart
Follow follow(const ScaleOptions& options, double bumps, unsigned seed) {
  constexpr double kWay = 1.4;
  constexpr double kSigma = 0.01;
  constexpr int kKeyframes = 2000;
  ScaleFilter filter(options);
  SceneGenerator random(seed);
  const double kept = std::exp(-kWay / 5.0);
  double truth_over_map = 2.0;
  double bump = random.normal(bumps);
  Follow result;
  for (int i = 0; i < kKeyframes; ++i) {
    truth_over_map *= std::exp(random.normal(options.map_drift));
    bump = kept * bump + random.normal(bumps * std::sqrt(1.0 - kept * kept));
    filter.drift(kWay, 0.0);
    truth_over_map /=
        filter.correct(truth_over_map * std::exp(bump + random.normal(kSigma)), kSigma);
    if (i >= 50) result.rms += std::pow(std::log(truth_over_map), 2) / (kKeyframes - 50);
  }
  result.rms = std::sqrt(result.rms);
  result.uncertainty = filter.uncertainty();
  return result;
}

TEST(ScaleFilter, AveragesNoisyMeasurementsOfADriftingMap) {
  ScaleOptions options;
  options.source = "stereo";
  options.map_drift = 0.01;
  const Follow followed = follow(options, 0.0, 5);
  EXPECT_LT(followed.rms, 0.9 * 0.01);  // the drift alone allows 0.8 of one measurement's error
  EXPECT_NEAR(followed.rms, followed.uncertainty, 0.1 * followed.uncertainty);
}

TEST(ScaleFilter, DoesNotCountOneBumpAsManyMeasurements) {
  const ScaleOptions options;
  const Follow honest = follow(options, options.road_uncertainty, 6);
  EXPECT_NEAR(honest.rms, honest.uncertainty, 0.15 * honest.uncertainty);
  ScaleOptions naive = options;
  naive.road_uncertainty = 0.0;
  const Follow sure = follow(naive, options.road_uncertainty, 6);
  EXPECT_GT(sure.rms, 2.0 * sure.uncertainty);
  EXPECT_LT(honest.rms, sure.rms);
}

TEST(ScaleFilter, KeepsTheMapsScaleAgainstASingleOutlier) {
  ScaleFilter filter{ScaleOptions{}};
  static_cast<void>(filter.correct(1.0, 0.02));
  EXPECT_DOUBLE_EQ(filter.correct(1.8, 0.03), 1.0);
  EXPECT_NEAR(filter.correct(1.02, 0.03), 1.0, 0.02);
}

TEST(ScaleFilter, BelievesLessOfAMeasurementThatSurprises) {
  const auto factor = [](double ratio) {
    ScaleFilter filter{ScaleOptions{}};
    static_cast<void>(filter.correct(1.0, 0.03));
    static_cast<void>(filter.drift(20.0, 0.0));  // the road there has its own error
    return std::log(filter.correct(ratio, 0.03));
  };
  EXPECT_GT(factor(1.05), 0.0);
  EXPECT_LT(factor(1.2), 2.5 * factor(1.05)) << "nearly four times the innovation";
  EXPECT_GT(factor(1.2), 0.0);
}

/// Factor after five measurements that the filter does not believe, so many metres apart.
double factor_after_contradictions(double apart) {
  ScaleFilter filter{ScaleOptions{}};
  static_cast<void>(filter.correct(1.0, 0.02));
  double factor = 1.0;
  for (int i = 0; i < 5; ++i) {
    static_cast<void>(filter.drift(apart, 0.0));
    factor *= filter.correct(1.8, 0.03);
  }
  return factor;
}

TEST(ScaleFilter, BelievesWhatIsSaidAgainAndAgain) {
  EXPECT_NEAR(factor_after_contradictions(3.0), 1.8, 1e-12);
}

TEST(ScaleFilter, DoesNotTakeOneFootwayForManyMeasurements) {
  EXPECT_DOUBLE_EQ(factor_after_contradictions(0.5), 1.0);
}

TEST(ScaleFilter, GrowsUncertainWithoutMeasurements) {
  ScaleFilter filter{ScaleOptions{}};
  static_cast<void>(filter.correct(1.0, 0.02));
  for (int i = 0; i < 500; ++i) filter.drift(1.0, 0.0);
  EXPECT_FALSE(filter.is_metric());
}

TEST(ScaleFilter, TrustsAMapWithPoorLandmarksLess) {
  const auto factor = [](double carried_sigma) {
    ScaleFilter filter{ScaleOptions{}};
    static_cast<void>(filter.correct(1.0, 0.02));
    for (int i = 0; i < 5; ++i) filter.drift(5.0, carried_sigma * carried_sigma);
    return filter.correct(1.05, 0.02);
  };
  EXPECT_LT(factor(0.0007), 1.03);  // a straight road on KITTI
  EXPECT_GT(factor(0.005), 1.035);  // a tight bend at walking pace
}

TEST(ScaleFilter, LosesMoreOfTheScaleInABend) {
  const auto uncertainty = [](double turn) {
    ScaleFilter filter{ScaleOptions{}};
    static_cast<void>(filter.correct(1.0, 0.01));
    for (int i = 0; i < 10; ++i) filter.drift(2.0, 0.0, 0.1 * turn);
    return filter.uncertainty();
  };
  const double straight = uncertainty(0.0), bend = uncertainty(0.9), other = uncertainty(-0.9);
  EXPECT_NEAR(std::sqrt(bend * bend - straight * straight), 0.057, 0.002) << "50 degrees";
  EXPECT_EQ(bend, other);
}

TEST(ScaleFilter, SaysHowFarMeasurementsSpeakForTheScaleBefore) {
  ScaleOptions options;
  options.source = "stereo";  // no error that lasts
  ScaleFilter filter(options);
  EXPECT_EQ(filter.drift(1.0, 0.0), 1.0);  // nothing known: the first measurement is for all
  static_cast<void>(filter.correct(1.0, options.map_drift));
  EXPECT_NEAR(filter.drift(1.0, 0.0), 0.5, 1e-12);
  EXPECT_NEAR(filter.drift(1.0, 0.0), 2.0 / 3.0, 1e-12);
}

TEST(ScaleFilter, IgnoresNumbersThatAreNone) {
  ScaleFilter filter{ScaleOptions{}};
  for (const double ratio : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_EQ(filter.correct(ratio, 0.1), 1.0);
  }
  EXPECT_FALSE(filter.is_metric());
}

/// Wheels on a map whose true scale is 1: keyframes are 2 m apart.
class ByWheels : public ::testing::Test {
 protected:
  static ScaleOptions options() {
    ScaleOptions options;
    options.source = "wheels";
    return options;
  }
  /// Wheels tell ways that are so many times too long.
  void tell(double too_long, int times) {
    for (int i = 0; i < times; ++i) {
      filter_.drift(2.0, 0.0);
      map_ *= filter_.correct(too_long / map_, 0.02);
    }
  }
  /// The scale that the map has, and should not.
  [[nodiscard]] double error() const { return std::abs(std::log(map_)); }

  ScaleFilter filter_{options()};
  double map_ = 0.2;
};

TEST_F(ByWheels, IsMetricOnlyWhenMeasurementsHaveAgreedOverAWay) {
  tell(1.0, 10);
  EXPECT_FALSE(filter_.is_metric());
  tell(1.0, 1);
  EXPECT_TRUE(filter_.is_metric());
  EXPECT_LT(error(), 1e-9);
}

TEST_F(ByWheels, IsNeverSurerThanTheSizeOfItsTyres) {
  tell(1.0, 2000);
  EXPECT_TRUE(filter_.is_metric());
  EXPECT_GE(filter_.uncertainty(), options().wheel_uncertainty);
  EXPECT_LT(filter_.uncertainty(), 1.2 * options().wheel_uncertainty);
}

TEST_F(ByWheels, IsDoubtedWhileWheelsSpinAndNotMovedByThem) {
  tell(1.0, 30);
  ASSERT_TRUE(filter_.is_metric());
  tell(1.8, 2);
  EXPECT_TRUE(filter_.is_metric()) << "a slip";
  tell(1.8, 30);
  EXPECT_FALSE(filter_.is_metric());
  EXPECT_LT(error(), 0.02);
  tell(1.0, 14);
  EXPECT_TRUE(filter_.is_metric());
  EXPECT_LT(error(), 0.02);
}

TEST_F(ByWheels, IsNotLedAwayByAnErrorThatComesAndGoesGently) {
  tell(1.0, 30);
  for (int i = 0; i <= 40; ++i) {
    tell(1.0 - 0.8 * std::sin(i * M_PI / 40), 1);
    if (filter_.is_metric()) {
      EXPECT_LT(error(), 3.0 * filter_.uncertainty()) << i;
    }
  }
}

TEST_F(ByWheels, TakesNoScaleOfWheelsThatAreOfTwoMinds) {
  for (int i = 0; i < 60; ++i) {
    tell(i % 3 == 0 ? 1.0 : 1.6, 1);
    EXPECT_FALSE(filter_.is_metric());
  }
}

TEST_F(ByWheels, HasToBeAgreedUponAgainWhenTheMapBeginsAnew) {
  tell(1.0, 30);
  filter_.lose();
  map_ = 3.0;
  EXPECT_FALSE(filter_.is_metric());
  tell(1.0, 10);
  EXPECT_FALSE(filter_.is_metric());
  tell(1.0, 2);
  EXPECT_TRUE(filter_.is_metric());
  EXPECT_LT(error(), 1e-9);
}

}  // namespace
}  // namespace oneac
