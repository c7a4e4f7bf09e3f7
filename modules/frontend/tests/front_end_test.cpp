#include "oneac/frontend/front_end.h"

#include "oneac/base/error.h"
#include "oneac/geometry/angular_errors.h"
#include "oneac/simulation/street_simulator.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

SimulationOptions small_drive() {
  SimulationOptions options;
  options.frames = 6;
  options.width_px = 480;
  options.height_px = 360;
  options.focal_px = 375;
  options.speed_mps = 6.0;
  return options;
}

CameraFrame frame_of(const StreetSimulator& street, std::size_t i) {
  CameraFrame frame;
  SimulatedFrame rendered = street.frame(i);
  frame.index = i;
  frame.time_s = rendered.state.time_s;
  frame.image = std::move(rendered.left);
  frame.camera = street.camera();
  frame.T_vehicle_cam = street.T_vehicle_cam();
  return frame;
}

RelativePose true_step(const StreetSimulator& street, std::size_t i) {
  const Eigen::Isometry3d T =
      street.state(i + 1).T_world_cam.inverse() * street.state(i).T_world_cam;
  return {T.linear(), T.translation()};
}

std::vector<FrameResult> drive(FrontEnd& front_end, const StreetSimulator& street) {
  std::vector<FrameResult> results;
  for (std::size_t i = 0; i < street.size(); ++i) {
    results.push_back(front_end.process(front_end.prepare(frame_of(street, i))));
  }
  return results;
}

TEST(FrontEnd, FollowsASimulatedDriveInMetres) {
  const StreetSimulator street(small_drive());
  FrontEnd front_end{FrontEndOptions{}};
  const auto results = drive(front_end, street);
  EXPECT_FALSE(results[0].step.has_value());
  EXPECT_DOUBLE_EQ(front_end.camera_height(), 1.5);  // from the mount
  std::size_t metric = 0;
  for (std::size_t i = 1; i < results.size(); ++i) {
    const RelativePose truth = true_step(street, i - 1);
    const StepResult& step = *results[i].step;
    ASSERT_EQ(step.status, StepStatus::kOk);
    EXPECT_LT(rotation_error(step.pose.R, truth.R), 0.2 * kDegree);
    EXPECT_LT(direction_error(step.pose.t, truth.t), 4.0 * kDegree);
    if (!step.metric) continue;
    ++metric;
    EXPECT_NEAR(step.length / truth.t.norm(), 1.0, 0.15);
  }
  EXPECT_GE(metric, 3U);
}

TEST(FrontEnd, ConcatenatesItsStepsWithoutAWindow) {
  const StreetSimulator street(small_drive());
  FrontEndOptions options;
  options.window.enabled = false;
  FrontEnd front_end{options};
  const auto results = drive(front_end, street);
  EXPECT_TRUE(results[0].T_first_cam.matrix().isIdentity());
  for (std::size_t i = 1; i < results.size(); ++i) {
    const Eigen::Isometry3d step = results[i].T_first_cam.inverse() * results[i - 1].T_first_cam;
    EXPECT_NEAR(step.translation().norm(), results[i].step->length, 1e-9);
    EXPECT_LT(rotation_error(step.linear(), results[i].step->pose.R), 1e-9);
  }
}

TEST(FrontEnd, SettlesEveryFrameOnceAndInOrder) {
  const StreetSimulator street(small_drive());
  FrontEnd front_end{FrontEndOptions{}};
  std::vector<std::size_t> frames;
  std::vector<Keyframe> keyframes;
  const auto take = [&](const Settled& settled) {
    for (const SettledFrame& frame : settled.frames) frames.push_back(frame.frame);
    keyframes.insert(keyframes.end(), settled.keyframes.begin(), settled.keyframes.end());
  };
  for (const FrameResult& result : drive(front_end, street)) take(result.settled);
  take(front_end.finish());
  ASSERT_EQ(frames.size(), street.size());
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i], i);
  ASSERT_GE(keyframes.size(), 2U);
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    EXPECT_EQ(keyframes[i].id, i);
    const Eigen::Isometry3d truth =
        street.state(0).T_world_cam.inverse() * street.state(keyframes[i].frame).T_world_cam;
    EXPECT_LT((keyframes[i].T_first_cam.translation() - truth.translation()).norm(),
              0.05 + 0.1 * truth.translation().norm());
    if (i > 0) {
      EXPECT_GT(keyframes[i].information.diagonal().minCoeff(), 0.0);
    }
  }
}

TEST(FrontEnd, AddsNoKeyframeWhileTheVehicleStands) {
  const StreetSimulator street(small_drive());
  FrontEnd front_end{FrontEndOptions{}};
  for (std::size_t i = 0; i < 3; ++i) {
    static_cast<void>(front_end.process(front_end.prepare(frame_of(street, i))));
  }
  for (int i = 1; i <= 5; ++i) {
    CameraFrame again = frame_of(street, 2);
    again.time_s += 5.0 + 0.5 * i;  // time enough to stop
    const FrameResult result = front_end.process(front_end.prepare(std::move(again)));
    EXPECT_FALSE(result.keyframe.has_value());
    EXPECT_EQ(result.step->length, 0.0);
  }
}

TEST(FrontEnd, MarksTheSegmentAfterTrackingWasLost) {
  SimulationOptions longer = small_drive();
  longer.frames = 9;
  const StreetSimulator street(longer);
  FrontEnd front_end{FrontEndOptions{}};
  std::vector<FrameResult> results;
  for (std::size_t i = 0; i < street.size(); ++i) {
    CameraFrame frame = frame_of(street, i);
    if (i == 5) frame.image = GreyImage(480, 360, 0);
    results.push_back(front_end.process(front_end.prepare(std::move(frame))));
  }
  EXPECT_EQ(results[4].step->segment, 0U);
  EXPECT_EQ(results.back().step->segment, 1U);
  EXPECT_EQ(results.back().step->status, StepStatus::kOk);
  EXPECT_TRUE(results.back().step->metric);
}

TEST(FrontEnd, IsNotMetricWithoutAHeight) {
  const StreetSimulator street(small_drive());
  FrontEnd front_end{FrontEndOptions{}};
  for (std::size_t i = 0; i < 3; ++i) {
    CameraFrame frame = frame_of(street, i);
    frame.T_vehicle_cam.translation().z() = 0.3;  // relative to the vehicle, not to the road
    const FrameResult result = front_end.process(front_end.prepare(std::move(frame)));
    if (!result.step) continue;
    EXPECT_FALSE(result.step->metric);
    EXPECT_NEAR(result.step->pose.t.norm(), 1.0, 1e-9);
  }
  EXPECT_EQ(front_end.camera_height(), 0.0);
}

TEST(FrontEnd, PredictsThroughABlackImage) {
  const StreetSimulator street(small_drive());
  FrontEnd front_end{FrontEndOptions{}};
  std::vector<FrameResult> results;
  for (std::size_t i = 0; i < 4; ++i) {
    CameraFrame frame = frame_of(street, i);
    if (i == 2) frame.image = GreyImage(480, 360, 0);
    results.push_back(front_end.process(front_end.prepare(std::move(frame))));
  }
  EXPECT_EQ(results[2].step->status, StepStatus::kPredicted);
  EXPECT_FALSE(results[2].step->metric);
  EXPECT_GT(results[2].step->length, 0.0);
  EXPECT_EQ(results[1].step->pose.R, results[2].step->pose.R);
}

TEST(FrontEnd, DoesNotBelieveACarThatTurnsBackInAnInstant) {
  SimulationOptions options = small_drive();
  options.frames = 10;
  const StreetSimulator street(options);
  FrontEnd front_end{FrontEndOptions{}};
  ASSERT_TRUE(drive(front_end, street).back().step->metric);
  CameraFrame before = frame_of(street, 8);
  before.time_s = frame_of(street, 9).time_s + 0.1;  // 6 m/s ahead, then 6 m/s astern
  before.index = 10;
  const FrameResult back = front_end.process(front_end.prepare(std::move(before)));
  EXPECT_EQ(back.step->status, StepStatus::kPredicted);
  EXPECT_FALSE(back.step->metric);
}

TEST(FrontEnd, ReportsAStandingVehicle) {
  const StreetSimulator street(small_drive());
  FrontEnd front_end{FrontEndOptions{}};
  static_cast<void>(front_end.process(front_end.prepare(frame_of(street, 0))));
  for (int i = 1; i <= 12; ++i) {
    CameraFrame again = frame_of(street, 0);
    again.time_s += 0.1 * i;
    const FrameResult result = front_end.process(front_end.prepare(std::move(again)));
    EXPECT_EQ(result.step->status, StepStatus::kNoMotion);
    EXPECT_EQ(result.step->metric, i >= 10) << i << ": a second of rest has to be seen";
    EXPECT_EQ(result.step->pose.t.norm(), 0.0);
  }
}

TEST(FrontEnd, InstancesDoNotDisturbEachOther) {
  const StreetSimulator street(small_drive());
  FrontEnd alone{FrontEndOptions{}};
  const auto expected = drive(alone, street);
  FrontEnd a{FrontEndOptions{}}, b{FrontEndOptions{}};
  for (std::size_t i = 0; i < street.size(); ++i) {
    const auto ra = a.process(a.prepare(frame_of(street, i)));
    static_cast<void>(b.process(b.prepare(frame_of(street, street.size() - 1 - i))));
    EXPECT_EQ(ra.T_first_cam.matrix(), expected[i].T_first_cam.matrix());
  }
}

TEST(FrontEnd, GivesTheSameBytesAtAnyThreadCount) {
  SimulationOptions longer = small_drive();
  longer.frames = 10;
  const StreetSimulator street(longer);
  FrontEnd alone{FrontEndOptions{}};
  const auto expected = drive(alone, street);
  for (const int threads : {2, 4}) {
    FrontEnd shared{FrontEndOptions{}, threads};
    const auto results = drive(shared, street);
    for (std::size_t i = 0; i < results.size(); ++i) {
      EXPECT_EQ(results[i].T_first_cam.matrix(), expected[i].T_first_cam.matrix()) << i;
      if (i == 0) continue;
      EXPECT_EQ(results[i].step->length, expected[i].step->length) << i;
      EXPECT_EQ(results[i].step->covariance, expected[i].step->covariance) << i;
    }
  }
}

TEST(FrontEnd, RefusesOptionsOutOfBoundsAndUnknownMethods) {
  FrontEndOptions options;
  options.camera_height = -1.0;
  EXPECT_THROW(FrontEnd{options}, std::invalid_argument);
  options = {};
  options.initialiser = "7pc";
  EXPECT_THROW(FrontEnd{options}, InputError);
}

}  // namespace
}  // namespace oneac
