#include "oneac/calibration/intrinsics_measurement.h"

#include "oneac/calibration/intrinsics_belief.h"
#include "oneac/test_support/synthetic_bend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace oneac {
namespace {

const IntrinsicsVector kHere = IntrinsicsVector::Zero();

IntrinsicsPrior vague() {
  return {0.5, 0.1, 1.0, 1.0};
}

SyntheticDrive bend() {
  SyntheticDrive drive;
  drive.turn = 0.03;
  return drive;
}

PinholeCamera wrong_camera(double focal_factor, double k1) {
  PinholeCamera camera = true_camera();
  camera.fx *= focal_factor;
  camera.fy *= focal_factor;
  camera.distortion[0] = k1;
  return camera;
}

TEST(MeasureIntrinsics, FindsTheCameraOfABendWithoutNoise) {
  PinholeCamera truth = true_camera();
  truth.distortion = {-0.1, 0.03, 0, 0, 0};
  const CalibrationWindow window = synthetic_window(bend(), truth);
  for (const double factor : {0.9, 1.1}) {
    const auto measured = measure_intrinsics(window, wrong_camera(factor, 0.0), kHere, vague(), {});
    ASSERT_TRUE(measured) << factor;
    const PinholeCamera found = changed(wrong_camera(factor, 0.0), measured->change);
    EXPECT_NEAR(found.fx / truth.fx, 1.0, 1e-3) << factor;
    EXPECT_NEAR(found.distortion[0], truth.distortion[0], 2e-3) << factor;
    EXPECT_NEAR(found.distortion[1], truth.distortion[1], 3e-3) << factor;
  }
}

TEST(MeasureIntrinsics, FindsAFisheyeOfABend) {
  PinholeCamera truth = true_camera();
  truth.lens = LensModel::kannala_brandt;
  truth.distortion = {-0.03, 0.01, -0.002, 0.0005};
  PinholeCamera guess = truth;
  guess.fx = guess.fy = 1.05 * truth.fx;
  guess.distortion[0] = guess.distortion[1] = 0.0;
  const CalibrationWindow window = synthetic_window(bend(), truth);
  const auto measured = measure_intrinsics(window, guess, kHere, vague(), {});
  ASSERT_TRUE(measured);
  const PinholeCamera found = changed(guess, measured->change);
  EXPECT_EQ(found.lens, LensModel::kannala_brandt);
  EXPECT_NEAR(found.fx / truth.fx, 1.0, 1e-3);
  EXPECT_NEAR(found.distortion[0], truth.distortion[0], 2e-3);
  EXPECT_NEAR(found.distortion[1], truth.distortion[1], 3e-3);
  EXPECT_EQ(found.distortion[2], truth.distortion[2]) << "is not learned";
}

TEST(MeasureIntrinsics, AStraightRoadLeavesTheFocalLengthToThePrior) {
  SyntheticDrive straight;
  straight.noise_px = 0.2;
  straight.nod = 0.0;
  const auto measured = measure_intrinsics(synthetic_window(straight, true_camera()),
                                           wrong_camera(1.05, 0.0), kHere, {}, {});
  ASSERT_TRUE(measured);
  EXPECT_LT(std::abs(measured->change[kFocal]), 0.01);
  IntrinsicsBelief belief(wrong_camera(1.05, 0.0), {});
  belief.add(*measured);
  belief.add(*measured);
  EXPECT_GT(belief.estimate().sigma(kFocal), 0.9 * IntrinsicsPrior{}.focal);
}

TEST(MeasureIntrinsics, ErrorsAreWhatTheInformationSays) {
  SyntheticDrive drive = bend();
  drive.noise_px = 0.3;
  drive.points = 150;
  int within = 0;
  double squares = 0.0;
  constexpr int kDrives = 16;
  for (int i = 0; i < kDrives; ++i) {
    drive.seed = 100U + static_cast<std::uint64_t>(i);
    const auto measured = measure_intrinsics(synthetic_window(drive, true_camera()),
                                             wrong_camera(0.97, 0.02), kHere, vague(), {});
    ASSERT_TRUE(measured) << "seed " << drive.seed;
    const IntrinsicsMatrix covariance = (measured->information + vague().information()).inverse();
    const double error = measured->change[kFocal] - std::log(1.0 / 0.97);
    const double ratio = error / std::sqrt(covariance(kFocal, kFocal));
    squares += ratio * ratio;
    if (std::abs(ratio) < 2.0) ++within;
  }
  EXPECT_GE(within, 14);
  EXPECT_GT(squares / kDrives, 0.4);  // nor is it far too careful
}

TEST(MeasureIntrinsics, WhatItCannotUseGivesNothing) {
  CalibrationWindow window = synthetic_window(bend(), true_camera());
  CalibrationWindow few = window;
  for (CalibrationView& view : few.views) view.sightings.resize(20);
  EXPECT_FALSE(measure_intrinsics(few, true_camera(), kHere, {}, {}));
  EXPECT_FALSE(measure_intrinsics({}, true_camera(), kHere, {}, {}));
  for (CalibrationView& view : window.views) {
    for (auto& s : view.sightings) s.u.x() = std::numeric_limits<double>::quiet_NaN();
  }
  EXPECT_FALSE(measure_intrinsics(window, true_camera(), kHere, {}, {}));
}

TEST(MeasureIntrinsics, MisuseIsNamed) {
  IntrinsicsPrior prior;
  prior.focal = 0.0;
  EXPECT_THROW(static_cast<void>(measure_intrinsics({}, true_camera(), kHere, prior, {})),
               std::invalid_argument);
}

TEST(MeasureIntrinsics, GrossErrorsDoNotMoveIt) {
  SyntheticDrive drive = bend();
  drive.noise_px = 0.2;
  CalibrationWindow window = synthetic_window(drive, true_camera());
  for (CalibrationView& view : window.views) {
    for (std::size_t i = 0; i < view.sightings.size(); i += 12) view.sightings[i].u.x() += 15.0;
  }
  const auto measured = measure_intrinsics(window, wrong_camera(1.05, 0.0), kHere, vague(), {});
  ASSERT_TRUE(measured);
  EXPECT_NEAR(changed(wrong_camera(1.05, 0.0), measured->change).fx, 720.0, 15.0);
}

}  // namespace
}  // namespace oneac
