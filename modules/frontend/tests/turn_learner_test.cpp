#include "camera/turn_learner.h"

#include "camera/camera_learner.h"
#include "camera/focal_doubt.h"

#include "oneac/test_support/synthetic_bend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

namespace oneac {
namespace {

constexpr double kFrame_s = 0.1;

/// [rad] round blocks: 6 s straight, then 90° within 4 s, to the left and to the right in turn.
double heading_at(double t) {
  const double in_block = std::fmod(t, 20.0), turn = M_PI / 8.0;
  if (in_block < 6.0) return 0.0;
  if (in_block < 10.0) return (in_block - 6.0) * turn;
  if (in_block < 16.0) return 4.0 * turn;
  return (20.0 - in_block) * turn;
}

/// Two minutes whose images see turns by a camera that is taken for so many times as long.
struct Blocks {
  double focal_too_long = 1.0;
  double gyroscope_scale = 1.0;
  double gyroscope_bias = 0.004;
  double gyroscope_late_s = 0.0;
  double course_late_s = 0.3;
  double course_swing = 0.0;  ///< [rad] to and fro, whatever the vehicle does

  template <class Learner>
  void tell_sensors(Learner& learner) const {
    for (int i = 0; i <= 12000; ++i) {
      const double t = 0.01 * i;
      const double then = t - gyroscope_late_s;
      const double rate = (heading_at(then) - heading_at(then - 0.01)) / 0.01;
      learner.add_yaw_rate(t, gyroscope_scale * rate + gyroscope_bias);
    }
    for (int t = 0; t <= 120; ++t) {
      const double swing = course_swing * std::sin(0.7 * t);
      learner.add_course(t, -heading_at(t - course_late_s) + swing, 8.0);
    }
  }
  [[nodiscard]] SettledFrame frame(std::size_t i) const {
    SettledFrame frame;
    frame.frame = i;
    const double seen = heading_at(kFrame_s * static_cast<double>(i)) / focal_too_long;
    // Counter-clockwise is about −Y of a level camera.
    frame.T_first_cam.linear() =
        Eigen::AngleAxisd(-seen, Eigen::Vector3d::UnitY()).toRotationMatrix();
    return frame;
  }
};

constexpr std::size_t kFrames = 1200;

TurnLearner driven(const Blocks& blocks) {
  TurnLearner learner;
  blocks.tell_sensors(learner);
  for (std::size_t i = 0; i < kFrames; ++i) {
    learner.add_frame(kFrame_s * static_cast<double>(i), i > 0, 0.0);
    static_cast<void>(learner.settle({blocks.frame(i)}, {}));
  }
  return learner;
}

TEST(TurnLearner, GyroscopeAndCourseTellAFocalLengthThatIsTooLong) {
  for (const double factor : {0.9, 0.95, 0.98, 1.0, 1.02, 1.05, 1.1}) {
    Blocks blocks;
    blocks.focal_too_long = factor;
    const auto told = driven(blocks).evidence();
    ASSERT_EQ(told.size(), 2U) << factor;
    for (const FocalEvidence& one : told) {
      EXPECT_NEAR(one.log_focal, -std::log(factor), 0.003) << one.sensor << " " << factor;
    }
  }
}

TEST(TurnLearner, TurnsSeenByACameraThatHasMovedCountForTheGivenOne) {
  Blocks blocks;
  blocks.focal_too_long = 1.0;  // in use: the right one, while the given one is 5 % too long
  TurnLearner learner;
  blocks.tell_sensors(learner);
  for (std::size_t i = 0; i < kFrames; ++i) {
    learner.add_frame(kFrame_s * static_cast<double>(i), i > 0, -std::log(1.05));
    static_cast<void>(learner.settle({blocks.frame(i)}, {}));
  }
  const auto told = learner.evidence();
  ASSERT_EQ(told.size(), 2U);
  EXPECT_NEAR(told.front().log_focal, -std::log(1.05), 0.003);
}

TEST(TurnLearner, SensorsThatAreLateTellTheSame) {
  Blocks blocks;
  blocks.focal_too_long = 1.05;
  blocks.gyroscope_late_s = 0.4;
  blocks.course_late_s = 0.9;
  const auto told = driven(blocks).evidence();
  ASSERT_EQ(told.size(), 2U);
  for (const FocalEvidence& one : told) {
    EXPECT_NEAR(one.log_focal, -std::log(1.05), 0.003) << one.sensor;
  }
}

TEST(TurnLearner, SensorsOfAnotherUnitOrSignTellNothing) {
  for (const double scale : {57.3, -1.0, 0.0}) {
    Blocks blocks;
    blocks.gyroscope_scale = scale;
    for (const FocalEvidence& one : driven(blocks).evidence()) {
      EXPECT_NE(one.sensor, "gyroscope") << scale;
    }
  }
}

/// A camera as given, by three windows with bends and the blocks' turns.
CameraLearner learned(const Blocks& blocks, int bends, const PinholeCamera& truth) {
  SelfCalibrationOptions options;
  options.refine = "focal";
  CameraLearner learner(options);
  learner.start(true_camera());
  blocks.tell_sensors(learner);
  for (int seed = 1; seed <= bends; ++seed) {
    SyntheticDrive drive;
    drive.turn = 0.03;
    drive.noise_px = 0.1;
    drive.seed = static_cast<std::uint64_t>(seed);
    std::size_t index = 0;
    for (const CalibrationView& view : synthetic_window(drive, truth).views) {
      NewestKeyframe keyframe{view.T_view_map, {}};
      for (const CalibrationSighting& seen : view.sightings) {
        keyframe.sightings.push_back(
            {1000U * drive.seed + seen.track, learner.used().normalise(seen.u)});
      }
      learner.follow(keyframe, index, 0.1 * static_cast<double>(index));
      ++index;
    }
  }
  learner.finish();
  for (std::size_t i = 0; i < kFrames; ++i) {
    learner.add_frame(kFrame_s * static_cast<double>(i), i > 0);
    learner.follow_turns({blocks.frame(i)}, {});
  }
  return learner;
}

TEST(CameraLearner, AGyroscopeThatConfirmsTheCameraTakesDoubtAway) {
  Blocks silent;
  silent.gyroscope_scale = 0.0;
  silent.course_late_s = 1e3;
  const CameraLearner alone = learned(silent, 2, true_camera());
  const CameraLearner confirmed = learned({}, 2, true_camera());
  EXPECT_TRUE(alone.belief().sensors.empty());
  EXPECT_EQ(confirmed.belief().sensors.size(), 2U);
  EXPECT_LE(confirmed.belief().focal_sigma, alone.belief().focal_sigma);
  EXPECT_LE(confirmed.belief().doubt, alone.belief().doubt);
  EXPECT_EQ(confirmed.used().fx, true_camera().fx);
}

TEST(CameraLearner, AGyroscopeWhoseScaleIsWrongMovesNothingAndIsNamed) {
  Blocks blocks;
  blocks.gyroscope_scale = 1.1;
  blocks.course_late_s = 1e3;
  const CameraLearner learner = learned(blocks, 3, true_camera());
  ASSERT_EQ(learner.belief().contradicting.size(), 1U);
  EXPECT_EQ(learner.belief().contradicting.front(), "gyroscope");
  EXPECT_EQ(learner.used().fx, true_camera().fx);
  EXPECT_FALSE(learner.fault());
  EXPECT_GT(learner.belief().focal_sigma, 0.02);
}

TEST(CameraLearner, ACourseThatIsGarbageMovesNoRightCamera) {
  for (const double swing : {0.1, 0.5, 1.5}) {
    Blocks blocks;
    blocks.course_swing = swing;
    const CameraLearner learner = learned(blocks, 2, true_camera());
    EXPECT_EQ(learner.used().fx, true_camera().fx) << swing;
    EXPECT_FALSE(learner.fault()) << swing;
    EXPECT_LT(learner.belief().doubt, 0.02) << swing;
  }
}

TEST(CameraLearner, AWrongGyroscopeDoesNotProtectAWrongCameraThatBendsAccuse) {
  PinholeCamera truth = true_camera();
  truth.fx /= 1.1;
  truth.fy /= 1.1;
  Blocks blocks;  // the camera in use is right by then; this says that the given one was
  blocks.gyroscope_scale = 1.0 / 1.1;
  blocks.course_late_s = 1e3;
  const CameraLearner learner = learned(blocks, 3, truth);
  EXPECT_EQ(learner.belief().contradicting.size(), 1U);
  EXPECT_TRUE(learner.fault());
}

TEST(CameraLearner, OneSensorWithoutBendsDoubtsTheCameraAndMovesNothing) {
  Blocks blocks;
  blocks.gyroscope_scale = 1.08;
  blocks.course_late_s = 1e3;
  const CameraLearner learner = learned(blocks, 0, true_camera());
  EXPECT_EQ(learner.used().fx, true_camera().fx);
  EXPECT_FALSE(learner.fault());
  EXPECT_GT(learner.belief().doubt, 0.04);
}

}  // namespace
}  // namespace oneac
