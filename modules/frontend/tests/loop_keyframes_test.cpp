#include "oneac/frontend/loop_keyframes.h"

#include <gtest/gtest.h>

#include <utility>

namespace oneac {
namespace {

/// A metre ahead, known to a centimetre.
FrameResult frame(bool first = false) {
  FrameResult result;
  if (first) return result;
  StepResult step;
  step.status = StepStatus::kOk;
  step.metric = true;
  step.pose.t = -Eigen::Vector3d::UnitZ();
  step.length = 1.0;
  step.length_sigma = 0.02;
  step.covariance = 1e-4 * Eigen::Matrix<double, 6, 6>::Identity();
  result.step = step;
  return result;
}

Keyframe keyframe(std::size_t id, std::size_t at) {
  Keyframe made;
  made.id = id;
  made.frame = at;
  made.index = 10 + at;
  made.metric = true;
  made.T_first_cam.translation().z() = static_cast<double>(at);
  made.points.resize(3);
  return made;
}

Settled settled(std::initializer_list<Keyframe> keyframes) {
  Settled made;
  made.keyframes = keyframes;
  return made;
}

OdometryStep metre() {
  return {frame().step->pose, frame().step->covariance};
}

/// Keyframes at frames 0, 2 and 5 of six, which settle late, as a map's do.
LoopKeyframes keyframes_of(std::vector<FrameResult> frames,
                           std::vector<Keyframe> keyframes = {keyframe(0, 0), keyframe(1, 2),
                                                              keyframe(2, 5)}) {
  LoopKeyframes made(0.05);
  frames[3].settled.keyframes = {keyframes[0], keyframes[1]};
  for (const FrameResult& result : frames) made.add(result);
  made.add(settled({keyframes[2]}));
  return made;
}

std::vector<FrameResult> six() {
  return {frame(true), frame(), frame(), frame(), frame(), frame()};
}

TEST(LoopKeyframes, AreAsUnsureAsTheStepsBetweenThemTogether) {
  const LoopKeyframes made = keyframes_of(six());
  ASSERT_EQ(made.settled().size(), 3u);
  EXPECT_TRUE(made.settled()[0].covariance.isZero());
  EXPECT_EQ(made.settled()[1].covariance, covariance_of_steps({metre(), metre()}));
  EXPECT_EQ(made.settled()[2].covariance, covariance_of_steps({metre(), metre(), metre()}));
}

TEST(LoopKeyframes, KeepWhatTheKeyframesSay) {
  const LoopKeyframes made = keyframes_of(six());
  const LoopKeyframe& last = made.settled().back();
  EXPECT_EQ(last.id, 2u);
  EXPECT_EQ(last.index, 15u);
  EXPECT_TRUE(last.metric);
  EXPECT_EQ(last.T_first_cam.translation().z(), 5.0);
  EXPECT_EQ(last.scale_sigma, 0.02);
  EXPECT_EQ(made.settled().front().scale_sigma, 0.05) << "no step leads there";
}

TEST(LoopKeyframes, HaveNoMetresWhereALengthWasHeld) {
  std::vector<FrameResult> frames = six();
  frames[2].step->metric = false;
  const LoopKeyframes made = keyframes_of(std::move(frames));
  EXPECT_TRUE(made.settled()[0].metric) << "no step leads there";
  EXPECT_FALSE(made.settled()[1].metric);
  EXPECT_TRUE(made.settled()[2].metric);
}

TEST(LoopKeyframes, NothingIsKnownOverALoss) {
  std::vector<FrameResult> frames = six();
  frames[4].step->status = StepStatus::kPredicted;
  EXPECT_TRUE(keyframes_of(std::move(frames)).settled()[2].covariance.isZero());
  Keyframe other = keyframe(2, 5);
  other.segment = 1;
  EXPECT_TRUE(keyframes_of(six(), {keyframe(0, 0), keyframe(1, 2), other})
                  .settled()[2]
                  .covariance.isZero());
}

TEST(LoopKeyframes, ANewMapBeginsWhereTheLastEnded) {
  Keyframe again = keyframe(2, 2);
  again.segment = 1;
  const LoopKeyframe made =
      keyframes_of(six(), {keyframe(0, 0), keyframe(1, 2), again}).settled()[2];
  EXPECT_EQ(made.scale_sigma, 0.02) << "of the step to that frame";
  EXPECT_TRUE(made.covariance.isZero());
}

TEST(LoopKeyframes, AStepWithoutMetresMayBeOfAnyLength) {
  std::vector<FrameResult> frames = six();
  frames[1].step->metric = frames[2].step->metric = false;
  frames[1].step->length = frames[2].step->length = 3.0;
  const LoopKeyframe made = keyframes_of(std::move(frames)).settled()[1];
  EXPECT_NEAR(made.covariance(2, 2), 2.0 * 9.0 * (1.0 + 1e-4), 1e-6);
  EXPECT_EQ(made.scale_sigma, 0.05) << "what all lengths share";
}

}  // namespace
}  // namespace oneac
