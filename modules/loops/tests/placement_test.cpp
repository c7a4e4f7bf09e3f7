#include "placement.h"

#include "loop_scenes.h"

#include "oneac/loops/pose_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace oneac::internal {
namespace {

constexpr std::size_t kLap = 80, kLaps = 3;

/// Three laps of a square, each a log with a frame of its own.
class PlacementOfLogs : public ::testing::Test {
 protected:
  const std::vector<Eigen::Isometry3d> truth_ = test::square_drive(40.0, kLaps);
  std::vector<LoopKeyframe> keyframes_ = in_logs(test::drifted(truth_, 0.02));

  static std::vector<LoopKeyframe> in_logs(std::vector<LoopKeyframe> keyframes) {
    for (std::size_t i = 0; i < keyframes.size(); ++i) {
      keyframes[i].log = i / kLap;
      const double far = 500.0 * static_cast<double>(i / kLap);
      keyframes[i].T_first_cam = test::pose_at(far, -far, 0.3 * far) * keyframes[i].T_first_cam;
    }
    return keyframes;
  }
  [[nodiscard]] std::vector<LoopConstraint> loops_between(std::size_t a, std::size_t b) const {
    std::vector<LoopConstraint> loops;
    for (std::size_t i = 0; i < kLap; i += 8) {
      loops.push_back(test::loop_between(truth_, a * kLap + i, b * kLap + i));
    }
    return loops;
  }
  /// [m] of keyframes against the truth, at most, in the frame of the first.
  [[nodiscard]] double farthest(const std::vector<Eigen::Isometry3d>& poses, std::size_t begin,
                                std::size_t end) const {
    double most = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      most = std::max(most, (poses[i].translation() - truth_[i].translation()).norm());
    }
    return most;
  }
};

TEST_F(PlacementOfLogs, FollowsLoopsFromLogToLog) {
  auto loops = loops_between(1, 2);
  const auto more = loops_between(0, 2);  // the second is joined by way of the third
  loops.insert(loops.end(), more.begin(), more.end());
  const Placement placed = place_parts(keyframes_, loops);
  EXPECT_LT(farthest(placed.T_group_cam, 0, truth_.size()), 2.0);
  EXPECT_TRUE(std::all_of(placed.group.begin(), placed.group.end(),
                          [](std::size_t first) { return first == 0; }));
  const ClosedGraph closed = optimise_pose_graph(keyframes_, loops);
  ASSERT_TRUE(closed.usable);
  for (std::size_t i = 0; i < kLap; i += 8) {
    const Eigen::Vector3d place = closed.T_first_cam[i].translation();
    EXPECT_LT((closed.T_first_cam[i + kLap].translation() - place).norm(), 0.1) << i;
    EXPECT_LT((closed.T_first_cam[i + 2 * kLap].translation() - place).norm(), 0.1) << i;
  }
}

TEST_F(PlacementOfLogs, LeavesALogThatNoLoopJoinsInItsOwnFrame) {
  const ClosedGraph closed = optimise_pose_graph(keyframes_, loops_between(0, 2));
  ASSERT_TRUE(closed.usable);
  EXPECT_EQ(closed.group[kLap - 1], 0U);
  EXPECT_EQ(closed.group[kLap], kLap);
  EXPECT_EQ(closed.group[2 * kLap], 0U);
  for (std::size_t i = kLap; i < 2 * kLap; ++i) {
    EXPECT_TRUE(closed.T_first_cam[i].isApprox(keyframes_[i].T_first_cam, 1e-9)) << i;
  }
}

TEST_F(PlacementOfLogs, JoinsAPartThatBeganAnewByLoopsBeforeItBelievesTheOdometry) {
  for (LoopKeyframe& keyframe : keyframes_) keyframe.log = 0;
  for (std::size_t i = kLap; i < keyframes_.size(); i += kLap) keyframes_[i].covariance.setZero();
  const Placement placed = place_parts(keyframes_, loops_between(0, 1));
  EXPECT_LT(farthest(placed.T_group_cam, 0, 2 * kLap), 2.0);
  // The third is tied to the second as the odometry guesses, in one frame with both.
  EXPECT_EQ(placed.group.back(), 0U);
  const Eigen::Isometry3d guess =
      keyframes_[2 * kLap - 1].T_first_cam.inverse() * keyframes_[2 * kLap].T_first_cam;
  EXPECT_TRUE((placed.T_group_cam[2 * kLap - 1].inverse() * placed.T_group_cam[2 * kLap])
                  .isApprox(guess, 1e-9));
}

TEST(Placement, OfNothingIsNothing) {
  EXPECT_TRUE(place_parts({}, {}).T_group_cam.empty());
}

}  // namespace
}  // namespace oneac::internal
