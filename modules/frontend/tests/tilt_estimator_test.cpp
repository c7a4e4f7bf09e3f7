#include "oneac/frontend/tilt_estimator.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// t of a camera with this pitch that drives `metres` along its road, nose wandering a little.
Eigen::Vector3d step_of(double pitch_up, double metres, double side = 0.0) {
  const Eigen::Vector3d t_level(side, 0.0, -metres);
  return leveling_rotation({pitch_up, 0.0}).transpose() * t_level;
}

TEST(TiltEstimator, StartsWithTheGivenTilt) {
  const TiltEstimator estimator({8.2 * kDegree, 0.3 * kDegree}, {});
  EXPECT_DOUBLE_EQ(estimator.tilt().pitch_up, 8.2 * kDegree);
  EXPECT_DOUBLE_EQ(estimator.tilt().roll_right, 0.3 * kDegree);
}

TEST(TiltEstimator, ConvergesToTheDirectionOfTravelDespiteTheSuspension) {
  TiltEstimator estimator({8.2 * kDegree, 0.0}, {});
  SceneGenerator scene(61);
  for (int i = 0; i < 200; ++i) {
    const double bounce = scene.normal(0.5 * kDegree);
    estimator.add_step(step_of(6.9 * kDegree + bounce, 0.5, 0.02));
  }
  EXPECT_NEAR(estimator.tilt().pitch_up, 6.9 * kDegree, 0.2 * kDegree);
}

TEST(TiltEstimator, LearnsTheSameFromBacking) {
  TiltEstimator estimator({0.0, 0.0}, {});
  for (int i = 0; i < 200; ++i) estimator.add_step(step_of(2.0 * kDegree, -0.5));
  EXPECT_NEAR(estimator.tilt().pitch_up, 2.0 * kDegree, 0.2 * kDegree);
}

TEST(TiltEstimator, TrustsTheGivenTiltAtFirst) {
  TiltEstimator estimator({0.0, 0.0}, {});
  estimator.add_step(step_of(5.0 * kDegree, 0.5));
  EXPECT_LT(estimator.tilt().pitch_up, 0.6 * kDegree);
}

TEST(TiltEstimator, IgnoresManoeuvresStandsAndAbsurdDirections) {
  TiltEstimator estimator({0.0, 0.0}, {});
  for (int i = 0; i < 50; ++i) {
    estimator.add_step(step_of(3.0 * kDegree, 0.2, 0.5));
    estimator.add_step(Eigen::Vector3d::Zero());
    estimator.add_step({0.0, -0.4, -0.9});
  }
  EXPECT_EQ(estimator.tilt().pitch_up, 0.0);
}

TEST(TiltEstimator, StaysPutWhenTold) {
  TiltOptions fixed;
  fixed.refine = false;
  TiltEstimator estimator({0.0, 0.0}, fixed);
  for (int i = 0; i < 50; ++i) estimator.add_step(step_of(3.0 * kDegree, 0.5));
  EXPECT_EQ(estimator.tilt().pitch_up, 0.0);
}

}  // namespace
}  // namespace oneac
