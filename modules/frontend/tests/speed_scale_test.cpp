#include "scale/speed_scale.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

/// A vehicle that speeds up, in a map whose unit is half a metre; the speeds of 1 Hz come late.
class SpeedScaleDrive : public ::testing::Test {
 protected:
  static constexpr double kUnitsPerMetre = 2.0;
  static double speed(double time_s) { return 5.0 + 0.8 * time_s; }

  SpeedScaleDrive() { scale_.restart(0.0); }
  void drive_until(double time_s) {
    while (time_ + 0.1 <= time_s + 1e-9) {
      time_ += 0.1;
      scale_.add_step(time_, kUnitsPerMetre * 0.1 * speed(time_ - 0.05));
    }
  }

  SpeedScale scale_;
  double time_ = 0.0;
};

TEST_F(SpeedScaleDrive, ComparesTheWayBetweenTwoFixesWithTheMaps) {
  scale_.add_speed({1.0, speed(1.0)});
  scale_.add_speed({2.0, speed(2.0)});
  drive_until(1.9);
  EXPECT_FALSE(scale_.measure().has_value()) << "the second fix lies ahead";
  drive_until(2.2);
  const auto measured = scale_.measure();
  ASSERT_TRUE(measured.has_value());
  EXPECT_NEAR(measured->ratio, 1.0 / kUnitsPerMetre, 1e-3);
  EXPECT_GT(measured->sigma, 0.01);
  EXPECT_LT(measured->sigma, 0.05);
  EXPECT_FALSE(scale_.measure().has_value()) << "an interval counts once";
}

TEST_F(SpeedScaleDrive, GuessesBeforeThereAreTwoFixes) {
  EXPECT_FALSE(scale_.first_guess().has_value());
  drive_until(1.0);
  EXPECT_FALSE(scale_.first_guess().has_value());
  scale_.add_speed({0.6, speed(0.6)});
  const auto guess = scale_.first_guess();
  ASSERT_TRUE(guess.has_value());
  EXPECT_NEAR(guess->ratio, 1.0 / kUnitsPerMetre, 0.03);
  EXPECT_LT(guess->sigma, 0.06);
}

TEST_F(SpeedScaleDrive, KeepsToTheMapWhenItIsRescaled) {
  scale_.add_speed({0.0, speed(0.0)});
  scale_.add_speed({1.0, speed(1.0)});
  drive_until(1.2);
  scale_.rescale(1.0 / kUnitsPerMetre);
  EXPECT_NEAR(scale_.measure()->ratio, 1.0, 1e-3);
}

TEST_F(SpeedScaleDrive, DoesNotMeasureAcrossARestart) {
  scale_.add_speed({0.0, speed(0.0)});
  scale_.add_speed({1.0, speed(1.0)});
  drive_until(0.5);
  scale_.restart(time_);
  drive_until(1.5);
  EXPECT_FALSE(scale_.measure().has_value());
}

TEST_F(SpeedScaleDrive, DoesNotMeasureAtWalkingSpeedNorOverALongGap) {
  scale_.add_speed({0.0, 0.4});
  scale_.add_speed({1.0, 0.4});
  scale_.add_speed({5.0, 8.0});
  drive_until(6.0);
  EXPECT_FALSE(scale_.measure().has_value());
}

TEST_F(SpeedScaleDrive, PassesOverSpeedsThatAreNone) {
  for (const double speed : {std::nan(""), HUGE_VAL, -1.0}) scale_.add_speed({0.5, speed});
  scale_.add_speed({std::nan(""), 5.0});
  drive_until(2.0);
  EXPECT_FALSE(scale_.measure().has_value());
  EXPECT_FALSE(scale_.first_guess().has_value());
}

}  // namespace
}  // namespace oneac
