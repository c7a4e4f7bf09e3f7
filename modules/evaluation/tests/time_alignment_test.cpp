#include "oneac/evaluation/time_alignment.h"

#include "oneac/evaluation/evaluate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

/// A winding drive.
Eigen::Isometry3d pose_at_time(double t) {
  const double yaw = 0.5 * std::sin(0.4 * t) + 0.2 * std::sin(1.1 * t + 1.0);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(5.0 * std::sin(0.3 * t), 0.0, 8.0 * t);
  return T;
}

Trajectory drive(double begin, double end, double step, double clock = 0.0) {
  Trajectory trajectory;
  for (int i = 0; begin + i * step < end; ++i) {
    trajectory.times.push_back(clock + begin + i * step);
    trajectory.poses.push_back(pose_at_time(begin + i * step));
  }
  return trajectory;
}

TEST(Resampled, InterpolatesBetweenRows) {
  const Trajectory reference = drive(0.0, 20.0, 0.1);
  std::vector<double> times;
  for (int i = 0; i < 100; ++i) times.push_back(0.05 + 0.1 * i);
  const ResampledReference at = resampled(reference, times, {});
  ASSERT_EQ(at.trajectory.poses.size(), times.size());
  EXPECT_EQ(at.interpolated, times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Eigen::Isometry3d truth = pose_at_time(times[i]);
    EXPECT_LT((at.trajectory.poses[i].translation() - truth.translation()).norm(), 0.01);
    EXPECT_LT(
        Eigen::AngleAxisd(at.trajectory.poses[i].linear().transpose() * truth.linear()).angle(),
        0.002);
  }
}

TEST(Resampled, TakesNoRowFartherThanAsked) {
  const Trajectory reference = drive(0.0, 20.0, 0.1);
  EXPECT_EQ(resampled(reference, {0.05, 0.11}, {0.0, 0.02}).trajectory.times,
            (std::vector<double>{0.11}));
  EXPECT_EQ(resampled(reference, {0.05, 0.11}, {}).trajectory.times.size(), 2U);
}

TEST(Resampled, BridgesNoGapUnlessAsked) {
  const Trajectory reference = drive(0.0, 20.0, 1.0);
  EXPECT_EQ(resampled(reference, {0.5, 1.0}, {}).trajectory.times, (std::vector<double>{1.0}));
  EXPECT_EQ(resampled(reference, {0.5, 1.0}, {0.0, 0.6}).trajectory.times.size(), 2U);
  EXPECT_TRUE(resampled(reference, {-5.0, 99.0}, {}).trajectory.times.empty());
}

TEST(Resampled, AddsTheOffsetToTheEstimate) {
  const Trajectory reference = drive(0.0, 20.0, 0.1, 1e9);
  const ResampledReference at = resampled(reference, {3.0}, {1e9, std::nullopt});
  ASSERT_EQ(at.trajectory.times, (std::vector<double>{3.0}));
  EXPECT_LT((at.trajectory.poses[0].translation() - pose_at_time(3.0).translation()).norm(), 1e-3);
}

TEST(EstimatedOffset, FindsTheClockByTheTurns) {
  for (const double clock : {0.0, -0.35, 18.0, 1.3e9}) {
    const auto offset = estimated_offset(drive(5.0, 45.0, 0.1), drive(0.0, 60.0, 0.05, clock));
    ASSERT_TRUE(offset) << clock;
    EXPECT_NEAR(*offset, clock, 0.02);
  }
}

TEST(EstimatedOffset, IsNoneOnAStraightRoad) {
  Trajectory straight;
  for (int i = 0; i < 400; ++i) {
    straight.times.push_back(0.1 * i);
    straight.poses.push_back(Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.8 * i)));
  }
  EXPECT_FALSE(estimated_offset(straight, straight));
  EXPECT_FALSE(estimated_offset(drive(0.0, 0.05, 0.1), straight));
}

}  // namespace
}  // namespace oneac
