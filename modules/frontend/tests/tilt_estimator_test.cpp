#include "oneac/frontend/tilt_estimator.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// t of a camera with this pitch that drives `metres` along its road, nose wandering a little.
RelativePose step_of(double pitch_up, double metres, double side = 0.0) {
  const Eigen::Vector3d t_level(side, 0.0, -metres);
  return {Eigen::Matrix3d::Identity(), levelling_rotation({pitch_up, 0.0}).transpose() * t_level};
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
  estimator.add_step(step_of(0.5 * kDegree, 0.5));
  EXPECT_LT(estimator.tilt().pitch_up, 0.1 * kDegree);
}

TEST(TiltEstimator, LetsGoOfAGivenTiltThatTheDriveContradicts) {
  TiltEstimator estimator({0.0, 0.0}, {});
  SceneGenerator scene(62);
  for (int i = 1; i <= 100; ++i) {
    estimator.add_step(step_of(7.0 * kDegree + scene.normal(0.3 * kDegree), 0.5));
    const double off = std::abs(estimator.tilt().pitch_up - 7.0 * kDegree);
    EXPECT_LT(off, 3.0 * estimator.belief().pitch_sigma) << "after " << i << " steps";
    EXPECT_TRUE(i < 5 || off < 0.5 * kDegree) << "after " << i << " steps";
  }
}

TEST(TiltEstimator, IsNoSurerThanWhatItHoldsBackForTheGivenTilt) {
  TiltEstimator estimator({1.5 * kDegree, 0.0}, {});
  for (int i = 0; i < 5; ++i) estimator.add_step(step_of(0.0, 0.5));
  EXPECT_LT(std::abs(estimator.tilt().pitch_up), 1.5 * estimator.belief().pitch_sigma);
}

TEST(TiltEstimator, IgnoresManoeuvresStandsAndAbsurdDirections) {
  TiltEstimator estimator({0.0, 0.0}, {});
  for (int i = 0; i < 50; ++i) {
    estimator.add_step(step_of(3.0 * kDegree, 0.2, 0.5));
    estimator.add_step(RelativePose{});
    estimator.add_step({Eigen::Matrix3d::Identity(), {0.0, -0.4, -0.9}});
  }
  EXPECT_EQ(estimator.tilt().pitch_up, 0.0);
}

TEST(TiltEstimator, LearnsNothingFromDirectionsThatImagesHardlyKnow) {
  TiltEstimator estimator({6.0 * kDegree, 0.0}, {});
  for (int i = 0; i < 100; ++i) estimator.add_step(step_of(0.0, 0.5), 5.0 * kDegree);
  EXPECT_DOUBLE_EQ(estimator.tilt().pitch_up, 6.0 * kDegree);
  for (int i = 0; i < 100; ++i) estimator.add_step(step_of(0.0, 0.5), 0.2 * kDegree);
  EXPECT_NEAR(estimator.tilt().pitch_up, 0.0, 0.5 * kDegree);
}

TEST(TiltEstimator, StaysPutWhenTold) {
  TiltOptions fixed;
  fixed.refine = false;
  TiltEstimator estimator({0.0, 0.0}, fixed);
  for (int i = 0; i < 50; ++i) estimator.add_step(step_of(3.0 * kDegree, 0.5));
  EXPECT_EQ(estimator.tilt().pitch_up, 0.0);
}

TEST(TiltEstimator, FindsATiltThatNobodyGives) {
  TiltOptions options;
  options.source = "drive";
  TiltEstimator estimator({}, options);
  EXPECT_GT(estimator.belief().pitch_sigma, 5.0 * kDegree);
  SceneGenerator scene(62);
  for (int i = 0; i < 20; ++i) {
    estimator.add_step(step_of(8.2 * kDegree + scene.normal(0.3 * kDegree), 0.5));
  }
  EXPECT_NEAR(estimator.tilt().pitch_up, 8.2 * kDegree, 0.3 * kDegree);
  EXPECT_LT(estimator.belief().pitch_sigma, 0.2 * kDegree);
}

TEST(TiltEstimator, FollowsASlowChange) {
  TiltEstimator estimator({}, {});
  for (int i = 0; i < 300; ++i) estimator.add_step(step_of(1.0 * kDegree, 0.5));
  for (int i = 0; i < 300; ++i) estimator.add_step(step_of(2.0 * kDegree, 0.5));
  EXPECT_NEAR(estimator.tilt().pitch_up, 2.0 * kDegree, 0.2 * kDegree);
}

TEST(TiltEstimator, LearnsRollFromTheAxisOfTurning) {
  TiltOptions options;
  options.source = "drive";
  TiltEstimator estimator({}, options);
  const Eigen::Matrix3d L = levelling_rotation({3.0 * kDegree, 2.0 * kDegree});
  SceneGenerator scene(63);
  for (int i = 0; i < 60; ++i) {
    const double turn = 2.0 * kDegree;
    const Eigen::Matrix3d bounce =
        rotation_from_vector({scene.normal(0.1 * kDegree), 0.0, scene.normal(0.1 * kDegree)});
    estimator.add_step(unlevel(
        {bounce * yaw_rotation(std::cos(turn), std::sin(turn)), Eigen::Vector3d(0.02, 0.0, -0.5)},
        L));
  }
  EXPECT_NEAR(estimator.tilt().pitch_up, 3.0 * kDegree, 0.3 * kDegree);
  EXPECT_NEAR(estimator.tilt().roll_right, 2.0 * kDegree, 0.5 * kDegree);
  EXPECT_LT(estimator.belief().roll_sigma, 1.0 * kDegree);
}

/// A right-angled bend, then a straight road on which the car wanders by a degree and bounces.
TEST(TiltEstimator, DoesNotForgetTheBendOnTheStraightRoad) {
  TiltEstimator estimator({}, {});
  const double roll = 1.0 * kDegree;
  const Eigen::Matrix3d L = levelling_rotation({0.0, roll});
  SceneGenerator scene(64);
  const auto drive = [&](double turn) {
    const Eigen::Matrix3d bounce = rotation_from_vector({scene.normal(0.2 * kDegree), 0.0, 0.0});
    estimator.add_step(
        unlevel({bounce * yaw_rotation(std::cos(turn), std::sin(turn)), {0.0, 0.0, -0.8}}, L));
  };
  for (int i = 0; i < 30; ++i) drive(3.0 * kDegree);
  const double after_the_bend = estimator.tilt().roll_right;
  EXPECT_NEAR(after_the_bend, roll, 1.5 * estimator.belief().roll_sigma);
  double farthest = 0.0;
  for (int i = 0; i < 300; ++i) {
    drive(scene.normal(0.3 * kDegree));
    farthest = std::max(farthest, std::abs(estimator.tilt().roll_right - after_the_bend));
  }
  EXPECT_LT(farthest, 0.2 * kDegree);
}

TEST(TiltEstimator, TakesTheNoiseOfTheTurnsFromTheDrive) {
  const auto sigma_with = [](double pitching) {
    TiltEstimator estimator({}, {});
    SceneGenerator scene(65);
    for (int i = 0; i < 60; ++i) {
      const Eigen::Matrix3d bounce = rotation_from_vector({scene.normal(pitching), 0.0, 0.0});
      estimator.add_step({bounce * yaw_rotation(std::cos(0.03), std::sin(0.03)), {0, 0, -0.8}});
    }
    return estimator.belief().roll_sigma;
  };
  EXPECT_GT(sigma_with(0.4 * kDegree), 1.5 * sigma_with(0.1 * kDegree));
}

TEST(TiltEstimator, KeepsTheGivenRollOnAStraightRoad) {
  TiltEstimator estimator({0.0, 1.0 * kDegree}, {});
  for (int i = 0; i < 100; ++i) estimator.add_step(step_of(0.0, 0.5));
  EXPECT_NEAR(estimator.tilt().roll_right, 1.0 * kDegree, 0.05 * kDegree);
  EXPECT_GT(estimator.belief().roll_sigma, 0.9 * kDegree);
}

TEST(TiltEstimator, LearnsRollFromThePlaneOfTheRoad) {
  const double roll = 4.0 * kDegree;
  TiltEstimator estimator({}, {}, false);
  SceneGenerator scene(66);
  EXPECT_NEAR(estimator.belief().roll_sigma, 2.0 * kDegree, 1e-9);
  for (int i = 0; i < 100; ++i) {
    estimator.see_road({roll + scene.normal(0.5 * kDegree), 0.5 * kDegree});
    estimator.add_step(step_of(0.0, 0.5));
    const double off = std::abs(estimator.tilt().roll_right - roll);
    EXPECT_LT(off, 2.0 * estimator.belief().roll_sigma) << "after " << i << " roads";
  }
  EXPECT_LT(estimator.belief().roll_sigma, 1.2 * kDegree);
  EXPECT_GT(estimator.belief().roll_sigma, 1.0 * kDegree) << "that road may itself be inclined";
}

TEST(TiltEstimator, BelievesARollThatSomebodyStatedMoreThanTheRoad) {
  TiltEstimator estimator({}, {});
  for (int i = 0; i < 100; ++i) estimator.see_road({2.0 * kDegree, 0.3 * kDegree});
  EXPECT_LT(estimator.tilt().roll_right, 1.0 * kDegree);
}

TEST(TiltEstimator, IsNotTurnedByOneRoadThatLiesAsKerbsDo) {
  TiltEstimator estimator({}, {}, false);
  for (int i = 0; i < 50; ++i) {
    estimator.see_road({(i % 5 == 0 ? 15.0 : 0.5) * kDegree, 0.5 * kDegree});
  }
  EXPECT_LT(std::abs(estimator.tilt().roll_right), 1.0 * kDegree);
}

TEST(TiltFromGravity, InvertsTheLevellingRotation) {
  const Tilt truth{8.2 * kDegree, -1.5 * kDegree};
  Eigen::Matrix3d R_vehicle_level;
  R_vehicle_level << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const Eigen::Matrix3d R_vehicle_cam = R_vehicle_level * levelling_rotation(truth);
  const Tilt found = tilt_from_gravity(R_vehicle_cam, {0.0, 0.0, 9.81});
  EXPECT_NEAR(found.pitch_up, truth.pitch_up, 1e-12);
  EXPECT_NEAR(found.roll_right, truth.roll_right, 1e-12);
}

}  // namespace
}  // namespace oneac
