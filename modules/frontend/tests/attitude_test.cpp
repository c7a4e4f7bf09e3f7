#include "attitude/attitude.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

TiltOptions given(double pitch_up_deg) {
  TiltOptions options;
  options.source = "params";
  options.pitch_up_deg = pitch_up_deg;
  return options;
}

/// A step of a car that drives straight ahead; its camera is pitched up by this.
StepResult ahead(double pitch_up) {
  StepResult step;
  step.status = StepStatus::kOk;
  step.time2 = 0.1;
  step.metric = true;
  step.length = 1.0;
  step.pose.t = levelling_rotation({pitch_up, 0.0}).transpose() * Eigen::Vector3d(0.0, 0.0, -1.0);
  return step;
}

/// Of a camera that looks ahead, as a log has it that says nothing of its mount.
Eigen::Matrix3d level_mount() {
  Eigen::Matrix3d level;
  level << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return level;
}

/// The same as two views see it.
TwoView seen_ahead(double pitch_up) {
  TwoView seen;
  seen.status = StepStatus::kOk;
  seen.pose = ahead(pitch_up).pose;
  return seen;
}

TEST(Attitude, IsLevelBeforeTheFirstFrame) {
  const Attitude attitude(given(8.0));
  EXPECT_EQ(attitude.mounting().tilt.pitch_up, 0.0);
  EXPECT_TRUE(attitude.now().R_level_cam.isIdentity());
  EXPECT_TRUE(attitude.before(Eigen::Matrix3d::Identity()).R_level_cam.isIdentity());
}

TEST(Attitude, TakesGravityThatWasFeltBeforeTheFirstFrame) {
  TiltOptions options;
  options.source = "imu";
  Attitude attitude(options);
  const Eigen::Vector3d leaning(9.81 * std::sin(2.0 * kDegree), 0.0, 9.81);
  for (int i = 0; i <= 1000; ++i) attitude.add_inertial({0.1 * i, leaning, std::nullopt});
  attitude.start(level_mount());
  EXPECT_NEAR(std::abs(attitude.mounting().tilt.pitch_up), 2.0 * kDegree, 0.3 * kDegree);
}

TEST(Attitude, DoubtsTheRollOfALogThatSaysNothingOfItsMount) {
  const Eigen::Matrix3d level = level_mount();
  const auto roll_sigma = [](const TiltOptions& options, const Eigen::Matrix3d& mount) {
    Attitude attitude(options);
    attitude.start(mount);
    return attitude.now().roll_sigma;
  };
  const Eigen::Matrix3d pitched = level * levelling_rotation({8.0 * kDegree, 0.0});
  EXPECT_NEAR(roll_sigma({}, level), 2.0 * kDegree, 1e-9);
  EXPECT_NEAR(roll_sigma({}, pitched), 1.0 * kDegree, 1e-9);
  EXPECT_NEAR(roll_sigma(given(0.0), level), 1.0 * kDegree, 1e-9) << "parameters were written";
}

TEST(Attitude, IsLevelledByTheFirstWayBeforeItsLengthIsAsked) {
  Attitude attitude({});
  attitude.start(level_mount());
  attitude.see(seen_ahead(7.0 * kDegree));
  const Eigen::Vector3d down = attitude.now().R_level_cam.row(1);
  EXPECT_NEAR(tilt_from_down(down).pitch_up, 7.0 * kDegree, 0.5 * kDegree);
  EXPECT_LT(attitude.now().pitch_sigma, 0.6 * kDegree);
}

TEST(Attitude, DoesNotGiveUpAMountThatWasStatedForOneWay) {
  Attitude attitude(given(7.8));
  attitude.start(level_mount());
  attitude.see(seen_ahead(2.0 * kDegree));
  const Eigen::Vector3d down = attitude.now().R_level_cam.row(1);
  const double off = std::abs(tilt_from_down(down).pitch_up - 7.8 * kDegree);
  EXPECT_LT(off, 2.0 * attitude.now().pitch_sigma) << "if the mount is right";
  EXPECT_GT(attitude.now().pitch_sigma, 1.0 * kDegree);
}

TEST(Attitude, CountsTheFirstWayOnce) {
  Attitude attitude({});
  attitude.start(level_mount());
  attitude.see(seen_ahead(7.0 * kDegree));
  const double before = attitude.now().pitch_sigma;
  attitude.follow(ahead(7.0 * kDegree));
  EXPECT_GE(attitude.now().pitch_sigma, before);
}

TEST(Attitude, IsNotLevelledByARestOrByALaterWay) {
  Attitude attitude(given(0.0));
  attitude.start(Eigen::Matrix3d::Identity());
  TwoView seen;
  seen.status = StepStatus::kNoMotion;
  attitude.see(seen);
  EXPECT_GT(attitude.now().pitch_sigma, 0.9 * kDegree);
  seen.status = StepStatus::kOk;
  seen.pose = ahead(0.0).pose;
  attitude.see(seen);
  const Levelling first = attitude.now();
  seen.pose = ahead(7.0 * kDegree).pose;
  attitude.see(seen);
  EXPECT_TRUE(attitude.now().R_level_cam.isApprox(first.R_level_cam));
}

TEST(Attitude, LearnsTheMountingAndLeavesTheSpringsTheRest) {
  Attitude attitude(given(3.0));
  attitude.start(Eigen::Matrix3d::Identity());
  for (int i = 0; i < 200; ++i) attitude.follow(ahead(4.0 * kDegree));
  EXPECT_NEAR(attitude.mounting().tilt.pitch_up, 4.0 * kDegree, 0.15 * kDegree);
  EXPECT_NEAR(attitude.suspension().angle, 0.0, 0.15 * kDegree);
  // The car brakes: the camera nods by a degree and goes on straight ahead.
  StepResult nod = ahead(3.0 * kDegree);
  nod.pose.R = pitch_rotation(1.0 * kDegree);
  attitude.follow(nod);
  EXPECT_NEAR(std::abs(attitude.suspension().angle), 1.0 * kDegree, 0.3 * kDegree);
  EXPECT_NEAR(attitude.mounting().tilt.pitch_up, 4.0 * kDegree, 0.15 * kDegree);
}

TEST(Attitude, KeepsItsMountThroughDirectionsThatImagesHardlyKnow) {
  Attitude attitude(given(6.0));
  attitude.start(level_mount());
  StepResult vague = ahead(0.0);
  vague.covariance.bottomRightCorner<3, 3>().diagonal().setConstant(std::pow(5.0 * kDegree, 2));
  for (int i = 0; i < 100; ++i) attitude.follow(vague);
  EXPECT_NEAR(attitude.mounting().tilt.pitch_up, 6.0 * kDegree, 0.1 * kDegree);
}

TEST(Attitude, LevelsAnEarlierViewByTheTurnSince) {
  Attitude attitude(given(3.0));
  attitude.start(Eigen::Matrix3d::Identity());
  for (int i = 0; i < 20; ++i) attitude.follow(ahead(3.0 * kDegree));
  const Levelling now = attitude.now();
  const Levelling same = attitude.before(Eigen::Matrix3d::Identity());
  EXPECT_LT((same.R_level_cam - now.R_level_cam).norm(), 1e-9);
  const Eigen::Matrix3d R_now_before = pitch_rotation(2.0 * kDegree);
  const Levelling before = attitude.before(R_now_before);
  const Eigen::AngleAxisd between(now.R_level_cam * R_now_before * before.R_level_cam.transpose());
  EXPECT_LT(between.angle(), 1e-6) << "both views are level";
  EXPECT_GT(before.pitch_sigma, 0.0);
  EXPECT_GT(before.roll_sigma, 0.0);
}

TEST(Attitude, IsLessSureAfterAStepThatTheImagesDidNotCarry) {
  Attitude attitude(given(3.0));
  attitude.start(Eigen::Matrix3d::Identity());
  for (int i = 0; i < 50; ++i) attitude.follow(ahead(3.0 * kDegree));
  const double before = attitude.now().pitch_sigma;
  StepResult lost;
  lost.status = StepStatus::kPredicted;
  attitude.follow(lost);
  EXPECT_GT(attitude.now().pitch_sigma, 1.5 * before);
}

}  // namespace
}  // namespace oneac
