#include "oneac/calibration/focal_evidence.h"

#include "oneac/test_support/synthetic_bend.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

constexpr double kPrior = 0.03;

/// Two bends that say that the camera is as given.
IntrinsicsBelief two_bends() {
  const IntrinsicsPrior prior{kPrior, 0.02, 0.05, 0.05};
  IntrinsicsBelief belief(true_camera(), prior);
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    SyntheticDrive drive;
    drive.turn = 0.03;
    drive.noise_px = 0.1;
    drive.seed = seed;
    const auto measured = measure_intrinsics(synthetic_window(drive, true_camera()), true_camera(),
                                             IntrinsicsVector::Zero(), prior, {});
    if (measured) belief.add(*measured);
  }
  return belief;
}

TEST(JointEstimate, AGyroscopeThatSaysWhatBendsSayMakesItSurer) {
  const IntrinsicsBelief bends = two_bends();
  const double alone = bends.estimate().sigma(kFocal);
  const JointEstimate joint = joint_estimate(bends, {{"gyroscope", 0.001, 0.5 * alone}});
  EXPECT_EQ(joint.agreeing.size(), 1U);
  EXPECT_TRUE(joint.contradicting.empty());
  EXPECT_LT(joint.estimate.sigma(kFocal), 0.8 * alone);
  EXPECT_TRUE(joint.is_confirmed());
}

TEST(JointEstimate, AGyroscopeThatContradictsBendsMovesNothingAndWidens) {
  const IntrinsicsBelief bends = two_bends();
  const IntrinsicsEstimate alone = bends.estimate();
  const JointEstimate joint = joint_estimate(bends, {{"gyroscope", 0.08, 0.01}});
  ASSERT_EQ(joint.contradicting.size(), 1U);
  EXPECT_EQ(joint.contradicting.front(), "gyroscope");
  EXPECT_TRUE(joint.agreeing.empty());
  EXPECT_EQ(joint.estimate.change, alone.change);
  EXPECT_GT(joint.estimate.sigma(kFocal), 2.0 * alone.sigma(kFocal));
  EXPECT_LE(joint.estimate.sigma(kFocal), kPrior * (1.0 + 1e-9));
}

TEST(JointEstimate, OneSensorWithoutBendsConfirmsNothingAndTwoThatContradictTellNothing) {
  const IntrinsicsBelief nothing(true_camera(), {kPrior, 0.02, 0.05, 0.05});
  EXPECT_FALSE(joint_estimate(nothing, {{"gyroscope", 0.02, 0.01}}).is_confirmed());
  EXPECT_TRUE(
      joint_estimate(nothing, {{"gyroscope", 0.02, 0.01}, {"course", 0.03, 0.01}}).is_confirmed());
  const JointEstimate apart =
      joint_estimate(nothing, {{"gyroscope", 0.05, 0.01}, {"course", -0.05, 0.01}});
  EXPECT_EQ(apart.contradicting.size(), 2U);
  EXPECT_EQ(apart.estimate.change[kFocal], 0.0);
  EXPECT_NEAR(apart.estimate.sigma(kFocal), kPrior, 1e-9);
}

}  // namespace
}  // namespace oneac
