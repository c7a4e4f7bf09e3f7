#include "oneac/loops/pose_graph.h"

#include "loop_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace oneac {
namespace {

constexpr std::size_t kLap = 80;

double worst(const std::vector<Eigen::Isometry3d>& poses,
             const std::vector<Eigen::Isometry3d>& truth) {
  double most = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    most = std::max(most, (poses[i].translation() - truth[i].translation()).norm());
  }
  return most;
}

class PoseGraph : public ::testing::Test {
 protected:
  const std::vector<Eigen::Isometry3d> truth_ = test::square_drive(40.0, 2);
  const std::vector<LoopKeyframe> keyframes_ = test::drifted(truth_, 0.05);

  [[nodiscard]] std::vector<Eigen::Isometry3d> odometry() const {
    std::vector<Eigen::Isometry3d> poses;
    for (const LoopKeyframe& keyframe : keyframes_) poses.push_back(keyframe.T_first_cam);
    return poses;
  }
  [[nodiscard]] std::vector<LoopConstraint> loops() const {
    std::vector<LoopConstraint> all;
    for (std::size_t i = 0; i < kLap; i += 4) {
      all.push_back(test::loop_between(truth_, i, i + kLap));
    }
    return all;
  }
};

TEST_F(PoseGraph, ClosesADriveThatDrifted) {
  const ClosedGraph closed = optimise_pose_graph(keyframes_, loops());
  ASSERT_TRUE(closed.usable);
  EXPECT_EQ(closed.loops.size(), loops().size());
  EXPECT_TRUE(closed.T_first_cam.front().isApprox(truth_.front()));
  EXPECT_GT(worst(odometry(), truth_), 3.0);
  EXPECT_LT(worst(closed.T_first_cam, truth_), worst(odometry(), truth_) / 4.0);
}

TEST_F(PoseGraph, TakesOutALoopThatDoesNotFit) {
  auto all = loops();
  all.push_back(test::loop_between(truth_, 21, 21 + kLap, {5.0, 0.0, 0.0}));
  const ClosedGraph closed = optimise_pose_graph(keyframes_, all);
  EXPECT_EQ(closed.loops.size(), all.size() - 1);
  EXPECT_TRUE(std::none_of(closed.loops.begin(), closed.loops.end(),
                           [](const LoopConstraint& loop) { return loop.first == 21; }));
  const ClosedGraph without = optimise_pose_graph(keyframes_, loops());
  EXPECT_LT(worst(closed.T_first_cam, without.T_first_cam), 1e-6);
}

TEST_F(PoseGraph, StaysAsItIsWithoutLoops) {
  const ClosedGraph closed = optimise_pose_graph(keyframes_, {});
  EXPECT_TRUE(closed.usable);
  EXPECT_EQ(worst(closed.T_first_cam, odometry()), 0.0);
  EXPECT_TRUE(optimise_pose_graph({}, {}).T_first_cam.empty());
}

TEST_F(PoseGraph, RefusesToCloseWhatCannotBeSolved) {
  auto keyframes = keyframes_;
  keyframes[7].T_first_cam.translation().x() = std::numeric_limits<double>::quiet_NaN();
  const ClosedGraph closed = optimise_pose_graph(keyframes, loops());
  EXPECT_TRUE(closed.loops.empty());
  EXPECT_TRUE(closed.T_first_cam[6].isApprox(odometry()[6]));
}

}  // namespace
}  // namespace oneac
