#include "chain.h"

#include "loop_scenes.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <vector>

namespace oneac::internal {
namespace {

/// @param step_m  from pose to pose, ahead
std::vector<Eigen::Isometry3d> straight_drive(std::size_t poses, double step_m) {
  std::vector<Eigen::Isometry3d> truth;
  truth.reserve(poses);
  for (std::size_t i = 0; i < poses; ++i) {
    truth.push_back(test::pose_at(0.0, step_m * static_cast<double>(i), 0.0));
  }
  return truth;
}

TEST(Chain, GoesBothWays) {
  const auto keyframes = test::drifted(test::square_drive(40.0, 1), 0.05);
  const Chain chain = test::chain_of(keyframes);
  const UncertainPose there = chain.between(5, 50), back = chain.between(50, 5);
  EXPECT_LT((there.T * back.T).matrix().cwiseAbs().maxCoeff() - 1.0, 1e-12);
  const UncertainPose again = inverse(back);
  EXPECT_LT((again.covariance - there.covariance).norm(), 1e-9 * there.covariance.norm());
  EXPECT_NEAR(chain.driven(20), 40.0, 1e-9);
}

TEST(Chain, CovarianceIsThatOfTheStepsItAddsUp) {
  auto truth = test::square_drive(40.0, 1);
  truth.resize(40);
  auto keyframes = test::drifted(truth, 0.0);
  for (LoopKeyframe& keyframe : keyframes) keyframe.scale_sigma = 0.0;
  const Matrix6 told = test::chain_of(keyframes).between(0, 39).covariance;
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  Matrix6 seen = Matrix6::Zero();
  constexpr int kTrials = 4000;
  for (int trial = 0; trial < kTrials; ++trial) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    for (std::size_t i = 1; i < truth.size(); ++i) {
      Eigen::Isometry3d error = Eigen::Isometry3d::Identity();
      const auto three = [&] {
        return Eigen::Vector3d(normal(generator), normal(generator), normal(generator));
      };
      error.linear() = rotation_from_vector(0.1 * kDegree * three());
      error.translation() = 0.02 * three();
      T = T * truth[i - 1].inverse() * truth[i] * error;
    }
    const Vector6 e = small_motion((truth[0].inverse() * truth[39]).inverse() * T);
    seen += e * e.transpose() / kTrials;
  }
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(seen(i, i) / told(i, i), 1.0, 0.12) << i;
}

TEST(Chain, WhatAllStepsShareLeadsADriveOffLikeAScrew) {
  constexpr double kShared = 0.02 * kDegree;
  const auto truth = test::square_drive(40.0, 5);
  auto keyframes = test::drifted(truth, 0.0);
  for (LoopKeyframe& keyframe : keyframes) keyframe.scale_sigma = 0.0;
  const std::size_t first = 7, last = truth.size() - 5;
  const Matrix6 alone = test::chain_of(keyframes).between(first, last).covariance;
  for (LoopKeyframe& keyframe : keyframes) keyframe.shared_rotation.setConstant(kShared);
  const Matrix6 told = test::chain_of(keyframes).between(first, last).covariance - alone;
  Matrix6 seen = Matrix6::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Isometry3d error = Eigen::Isometry3d::Identity();
    error.linear() = rotation_from_vector(1e-3 * kShared * Eigen::Vector3d::Unit(axis));
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    for (std::size_t i = first + 1; i <= last; ++i) {
      T = T * truth[i - 1].inverse() * truth[i] * error;
    }
    const Vector6 e = 1e3 * small_motion((truth[first].inverse() * truth[last]).inverse() * T);
    seen += e * e.transpose();
  }
  EXPECT_LT((told - seen).norm(), 0.02 * seen.norm());
  EXPECT_GT(told(1, 1), 4.0 * alone(1, 1)) << "upwards it counts most";
}

TEST(Chain, LengthsOfAStretchAreWrongByOneFactor) {
  const auto truth = straight_drive(30, 2.0);
  const UncertainPose way = test::chain_of(test::drifted(truth, 0.0)).between(0, 29);
  EXPECT_GT(std::sqrt(way.covariance(2, 2)), 0.01 * 58.0);  // ahead
  EXPECT_LT(std::sqrt(way.covariance(1, 1)), 0.01 * 58.0);
}

/// 10 m/s, ten keyframes a second; nothing is known of the 2.1 s after the 40th, in which a car
/// drives 21 m, or 27 m as fast as it can.
std::vector<LoopKeyframe> with_a_gap() {
  auto keyframes = test::drifted(straight_drive(80, 1.0), 0.0);
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    keyframes[i].time_s = 0.1 * static_cast<double>(i) + (i < 40 ? 0.0 : 2.0);
  }
  keyframes[40].covariance.setZero();
  return keyframes;
}

TEST(Chain, NoCarLeapsOverAGap) {
  const Chain chain = test::chain_of(with_a_gap());
  const auto can = [&](double ahead) {  // of keyframe 35 is keyframe 45: 4 m and 5 m from the gap
    const Eigen::Isometry3d T = test::pose_at(0.0, ahead, 0.0);
    EXPECT_EQ(chain.can_be_driven(35, 45, T), chain.can_be_driven(45, 35, T.inverse()));
    return chain.can_be_driven(35, 45, T);
  };
  EXPECT_TRUE(can(30.0));
  EXPECT_FALSE(can(60.0));
  EXPECT_FALSE(can(-30.0)) << "a street that looks like the one before";
}

TEST(Chain, TheDriftOnEitherSideOfAGapIsAllowedFor) {
  auto keyframes = with_a_gap();
  for (std::size_t i = 36; i < 40; ++i) keyframes[i].covariance.diagonal().head<3>().setConstant(9);
  const Eigen::Isometry3d T = test::pose_at(0.0, 60.0, 0.0);
  EXPECT_TRUE(test::chain_of(keyframes).can_be_driven(35, 45, T));
}

TEST(Chain, ALongGapOrAnotherLogBoundsNothing) {
  auto keyframes = with_a_gap();
  const Eigen::Isometry3d far = test::pose_at(0.0, -400.0, 0.0);
  for (std::size_t i = 40; i < keyframes.size(); ++i) keyframes[i].time_s += 20.0;
  EXPECT_TRUE(test::chain_of(keyframes).can_be_driven(35, 45, far));
  keyframes = with_a_gap();
  for (std::size_t i = 40; i < keyframes.size(); ++i) keyframes[i].log = 1;
  EXPECT_TRUE(test::chain_of(keyframes).can_be_driven(35, 45, far));
}

TEST(Chain, KnowsNothingBeyondAStepThatIsUnknown) {
  auto keyframes = test::drifted(test::square_drive(40.0, 1), 0.0);
  keyframes[10].covariance.setZero();
  const Chain chain = test::chain_of(keyframes);
  EXPECT_GT(chain.between(9, 10).covariance(0, 0), 1e5);
  EXPECT_LT(chain.between(10, 12).covariance(0, 0), 1.0);
}

TEST(Chain, KnowsNothingBetweenTwoLogsAndEverythingInEach) {
  auto keyframes = test::drifted(test::square_drive(40.0, 1), 0.0);
  const Chain one = test::chain_of(keyframes);
  for (std::size_t i = 10; i < keyframes.size(); ++i) keyframes[i].log = 1;
  const Chain two = test::chain_of(keyframes);
  EXPECT_FALSE(two.known(9, 10));
  EXPECT_GT(two.between(9, 10).covariance(0, 0), 1e5);
  EXPECT_GT(two.driven(10) - two.driven(9), 1e6);
  const Matrix6 before = one.between(12, 30).covariance;
  EXPECT_LT((two.between(12, 30).covariance - before).norm(), 1e-9 * before.norm());
  EXPECT_EQ(two.part(30), 1U);
}

TEST(Chain, ErrorsOfStepsAddUpAsLoopsDo) {
  const OdometryStep step{{yaw_rotation(std::cos(0.2), std::sin(0.2)), {0.1, 0.0, -2.0}},
                          test::step_covariance()};
  LoopConstraint loop;
  loop.T_2_1 = step.T_2_1;
  loop.covariance = step.covariance;
  EXPECT_LT((covariance_of_steps({step}) - of_loop(loop).covariance).norm(), 1e-15);
  const UncertainPose two = of_loop(loop) * of_loop(loop);
  EXPECT_LT((covariance_of_steps({step, step}) - two.covariance).norm(), 1e-15);
  EXPECT_TRUE(covariance_of_steps({}).isZero());
}

TEST(Chain, LoopIsTheInverseOfItsMotionWithItsUncertainty) {
  LoopConstraint loop = test::loop_between({test::pose_at(0, 0, 0), test::pose_at(1, 3, 10)}, 0, 1);
  const UncertainPose pose = of_loop(loop);
  EXPECT_LT((pose.T.translation() - Eigen::Vector3d(1, 0, 3)).norm(), 1e-12);
  // Numerically: move (w, t) by each unit and see the change on the right.
  Matrix6 J;
  for (int i = 0; i < 6; ++i) {
    constexpr double kStep = 1e-6;
    Vector6 d = Vector6::Zero();
    d(i) = kStep;
    LoopConstraint moved = loop;
    moved.T_2_1.R = rotation_from_vector(d.head<3>()) * loop.T_2_1.R;
    moved.T_2_1.t += d.tail<3>();
    J.col(i) = small_motion(pose.T.inverse() * of_loop(moved).T) / kStep;
  }
  EXPECT_LT((J * loop.covariance * J.transpose() - pose.covariance).norm(), 1e-8);
  const Matrix6 information = g2o_information(loop);
  EXPECT_NEAR(information(0, 0) * pose.covariance.inverse()(0, 0), std::pow(information(0, 0), 2),
              1e-6 * std::pow(information(0, 0), 2));
}

}  // namespace
}  // namespace oneac::internal
