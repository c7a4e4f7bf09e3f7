#include "oneac/calibration/intrinsics_belief.h"

#include "oneac/test_support/synthetic_bend.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

/// Says ln(f / f₀) = `focal` ± `sigma`, and nothing of the rest.
IntrinsicsMeasurement focal_measurement(double focal, double sigma) {
  IntrinsicsMeasurement measured;
  measured.information.setZero();
  measured.information(kFocal, kFocal) = 1.0 / (sigma * sigma);
  measured.pull.setZero();
  measured.pull[kFocal] = focal / (sigma * sigma);
  return measured;
}

TEST(IntrinsicsBelief, WithoutADriveItIsThePrior) {
  const IntrinsicsEstimate estimate = IntrinsicsBelief(true_camera(), {}).estimate();
  EXPECT_EQ(estimate.camera.fx, true_camera().fx);
  EXPECT_NEAR(estimate.sigma(kFocal), IntrinsicsPrior{}.focal, 1e-12);
  EXPECT_NEAR(estimate.sigma(kK1), IntrinsicsPrior{}.k1, 1e-12);
  EXPECT_GT(estimate.drive_sigma[kFocal], 1e3);
}

TEST(IntrinsicsBelief, WindowsThatAgreeAddUpAndLeaveTheRestToThePrior) {
  IntrinsicsBelief belief(true_camera(), {});
  for (int i = 0; i < 8; ++i) belief.add(focal_measurement(0.02, 0.002));
  const IntrinsicsEstimate estimate = belief.estimate();
  EXPECT_NEAR(estimate.change[kFocal], 0.02, 1e-3);
  EXPECT_LT(estimate.sigma(kFocal), 0.004);
  EXPECT_GT(estimate.sigma(kFocal), 0.0015);
  EXPECT_NEAR(estimate.sigma(kK1), IntrinsicsPrior{}.k1, 1e-12);
}

TEST(IntrinsicsBelief, OneWindowAloneMovesNothing) {
  IntrinsicsBelief belief(true_camera(), {});
  belief.add(focal_measurement(0.15, 0.005));
  const IntrinsicsEstimate estimate = belief.estimate();
  EXPECT_EQ(estimate.camera.fx, true_camera().fx);
  EXPECT_NEAR(estimate.sigma(kFocal), IntrinsicsPrior{}.focal, 1e-12);
  EXPECT_EQ(estimate.windows, 1U);
}

TEST(IntrinsicsBelief, WindowsThatContradictEachOtherMakeItLessSure) {
  IntrinsicsBelief belief(true_camera(), {});
  for (const double focal : {0.04, -0.03, 0.05, -0.04}) {
    belief.add(focal_measurement(focal, 0.002));
  }
  EXPECT_GT(belief.estimate().sigma(kFocal), 0.01);
}

TEST(IntrinsicsBelief, WhatAnotherSensorSaysCountsAloneAndMovesNothingButTheFocalLength) {
  IntrinsicsBelief belief(true_camera(), {0.1});
  belief.add(focal_measurement(0.15, 0.005));
  belief.add_focal(0.04, 0.003);
  const IntrinsicsEstimate estimate = belief.estimate();
  EXPECT_NEAR(estimate.change[kFocal], 0.04, 1e-4);
  EXPECT_NEAR(estimate.sigma(kFocal), 0.003, 1e-4);
  EXPECT_EQ(estimate.camera.cx, true_camera().cx);
  EXPECT_NEAR(estimate.sigma(kK1), IntrinsicsPrior{}.k1, 1e-12);
}

TEST(IntrinsicsBelief, ASensorThatContradictsTheBendsMakesItLessSure) {
  IntrinsicsBelief agrees(true_camera(), {0.1}), differs(true_camera(), {0.1});
  for (IntrinsicsBelief* belief : {&agrees, &differs}) {
    for (int i = 0; i < 4; ++i) belief->add(focal_measurement(0.02, 0.001));
  }
  agrees.add_focal(0.02, 0.002);
  differs.add_focal(0.05, 0.002);
  EXPECT_GT(differs.estimate().sigma(kFocal), 3.0 * agrees.estimate().sigma(kFocal));
}

}  // namespace
}  // namespace oneac
