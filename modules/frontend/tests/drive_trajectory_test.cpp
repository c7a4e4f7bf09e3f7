#include "oneac/frontend/drive_trajectory.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

FrameResult result_at(std::size_t index, double x) {
  FrameResult result;
  result.index = index;
  result.time_s = static_cast<double>(index);
  result.T_first_cam.translation().x() = x;
  return result;
}

SettledFrame settled_at(std::size_t frame, double x) {
  SettledFrame settled{frame, Eigen::Isometry3d::Identity()};
  settled.T_first_cam.translation().x() = x;
  return settled;
}

TEST(DriveTrajectory, ReplacesPosesByWhatBecomesFinal) {
  DriveTrajectory trajectory;
  trajectory.add(result_at(4, 1.0));
  FrameResult second = result_at(8, 2.0);
  second.settled.frames.push_back(settled_at(0, 1.5));
  trajectory.add(second);
  ASSERT_EQ(trajectory.poses().size(), 2U);
  EXPECT_EQ(trajectory.poses()[0].index, 4U);
  EXPECT_EQ(trajectory.poses()[0].T_first_cam.translation().x(), 1.5);
  EXPECT_TRUE(trajectory.poses()[0].settled);
  EXPECT_FALSE(trajectory.poses()[1].settled);
}

TEST(DriveTrajectory, IsFinalAtTheEndOfTheDrive) {
  DriveTrajectory trajectory;
  trajectory.add(result_at(0, 1.0));
  trajectory.add(result_at(1, 2.0));
  trajectory.finish({{settled_at(1, 2.5), settled_at(7, 9.0)}, {}});
  EXPECT_EQ(trajectory.poses()[1].T_first_cam.translation().x(), 2.5);
  for (const FramePose& pose : trajectory.poses()) EXPECT_TRUE(pose.settled);
}

}  // namespace
}  // namespace oneac
