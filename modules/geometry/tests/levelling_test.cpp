#include "oneac/geometry/levelling.h"

#include "oneac/geometry/camera_frame.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

namespace oneac {
namespace {

constexpr double kDegree = 0.017453292519943295;

const Eigen::Vector3d kGravity = Eigen::Vector3d::UnitY();  // in a levelled camera

Eigen::Matrix3d level_mount() {
  return CameraFrame::forward_looking_mount().linear();
}

/// R_vehicle_sensor from MRPT's yaw (about Z), pitch (about Y), roll (about X) in degrees.
Eigen::Matrix3d ypr_deg(double yaw, double pitch, double roll) {
  return (Eigen::AngleAxisd(yaw * kDegree, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(pitch * kDegree, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll * kDegree, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

TEST(LevellingRotation, PositivePitchIsAnAxisAboveTheHorizon) {
  const Eigen::Matrix3d L = levelling_rotation({8 * kDegree, 0});
  const Eigen::Vector3d axis = L * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(axis.y(), -std::sin(8 * kDegree), 1e-14);  // Y down: negative is up
  EXPECT_NEAR(axis.z(), std::cos(8 * kDegree), 1e-14);
  EXPECT_NEAR(axis.x(), 0.0, 1e-14);
}

TEST(LevellingRotation, PositiveRollIsARightSideThatHangsDown) {
  const Eigen::Matrix3d L = levelling_rotation({0, 5 * kDegree});
  const Eigen::Vector3d right = L * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(right.y(), std::sin(5 * kDegree), 1e-14);  // Y down
  EXPECT_NEAR((L * Eigen::Vector3d::UnitZ()).z(), 1.0, 1e-14);
}

TEST(LevellingRotation, KeepsTheHeading) {
  const Eigen::Matrix3d L = levelling_rotation({0.2, -0.1});
  EXPECT_NEAR((L * Eigen::Vector3d::UnitZ()).x(), 0.0, 1e-14);
}

TEST(TiltFromMounting, OfALevelCameraIsZero) {
  const Tilt tilt = tilt_from_mounting(level_mount());
  EXPECT_NEAR(tilt.pitch_up, 0.0, 1e-14);
  EXPECT_NEAR(tilt.roll_right, 0.0, 1e-14);
}

TEST(TiltFromMounting, OfTheMalagaMountIsItsEightDegreesUpward) {
  // Sensor pose x-forward with yaw 0, pitch -8.2°, roll 0: MRPT's positive pitch looks down.
  const Tilt tilt = tilt_from_mounting(ypr_deg(0, -8.2, 0) * level_mount());
  EXPECT_NEAR(tilt.pitch_up, 8.2 * kDegree, 1e-12);
  EXPECT_NEAR(tilt.roll_right, 0.0, 1e-12);
}

TEST(TiltFromMounting, OfAnOpticalFrameMountIsThatOfItsAxes) {
  // Yaw -90°, pitch 0, roll -90° is the level optical frame itself.
  const Tilt tilt = tilt_from_mounting(ypr_deg(-90, 0, -90));
  EXPECT_NEAR(tilt.pitch_up, 0.0, 1e-12);
  EXPECT_NEAR(tilt.roll_right, 0.0, 1e-12);
}

TEST(TiltFromMounting, OfAVehicleRolledRightIsRolledRight) {
  // Roll about X (forward), positive: Y (left) rises, the right side hangs down.
  const Tilt tilt = tilt_from_mounting(ypr_deg(0, 0, 5) * level_mount());
  EXPECT_NEAR(tilt.roll_right, 5 * kDegree, 1e-12);
  EXPECT_NEAR(tilt.pitch_up, 0.0, 1e-12);
}

TEST(TiltFromMounting, DoesNotDependOnTheHeading) {
  const Tilt ahead = tilt_from_mounting(ypr_deg(0, -8, 3) * level_mount());
  const Tilt aside = tilt_from_mounting(ypr_deg(70, -8, 3) * level_mount());
  EXPECT_NEAR(ahead.pitch_up, aside.pitch_up, 1e-12);
  EXPECT_NEAR(ahead.roll_right, aside.roll_right, 1e-12);
}

TEST(TiltFromMounting, RecoversTheTiltOfTheLevellingRotation) {
  SceneGenerator scenes(21);
  for (int i = 0; i < 1000; ++i) {
    const Tilt truth{scenes.uniform(-1.0, 1.0), scenes.uniform(-1.0, 1.0)};
    // The camera sees gravity in Lᵀ; R_vehicle_cam = R_vehicle_level L.
    const Eigen::Matrix3d R_vehicle_cam = level_mount() * levelling_rotation(truth);
    const Tilt tilt = tilt_from_mounting(R_vehicle_cam);
    EXPECT_NEAR(tilt.pitch_up, truth.pitch_up, 1e-12) << "seed 21, scene " << i;
    EXPECT_NEAR(tilt.roll_right, truth.roll_right, 1e-12) << "seed 21, scene " << i;
  }
}

TEST(TiltFromMounting, LeadsGravityToYWhateverTheMount) {
  SceneGenerator scenes(22);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Matrix3d R_vehicle_cam =
        ypr_deg(scenes.uniform(-180, 180), scenes.uniform(-60, 60), scenes.uniform(-60, 60)) *
        level_mount();
    const Eigen::Vector3d gravity_cam = R_vehicle_cam.transpose() * Eigen::Vector3d(0, 0, -1);
    const Eigen::Matrix3d L = levelling_rotation(tilt_from_mounting(R_vehicle_cam));
    EXPECT_LT((L * gravity_cam - kGravity).norm(), 1e-12) << "seed 22, scene " << i;
  }
}

TEST(Level, DescribesTheSameMotionInLevelledFrames) {
  SceneGenerator scenes(23);
  for (int i = 0; i < 1000; ++i) {
    const RelativePose T = scenes.general_motion();
    const Eigen::Matrix3d L = levelling_rotation({scenes.uniform(-1, 1), scenes.uniform(-1, 1)});
    const Eigen::Vector3d X1(scenes.uniform(-5, 5), scenes.uniform(-5, 5), scenes.uniform(1, 20));
    const Eigen::Vector3d X2_level = level(T, L) * (L * X1);
    EXPECT_LT((X2_level - L * (T * X1)).norm(), 1e-12) << "seed 23, scene " << i;
  }
}

TEST(Level, IsUndoneByUnlevel) {
  SceneGenerator scenes(24);
  const RelativePose T = scenes.general_motion();
  const Eigen::Matrix3d L = levelling_rotation({0.14, -0.05});
  const RelativePose back = unlevel(level(T, L), L);
  EXPECT_LT((back.R - T.R).norm(), 1e-14);
  EXPECT_LT((back.t - T.t).norm(), 1e-14);
}

TEST(Unlevel, LetsACameraThatLooksUpSinkBelowItsAxisWhenDrivingLevel) {
  // Level forward motion of a camera that looks 8° up: it moves forward and down in its own frame.
  const RelativePose level_forward{Eigen::Matrix3d::Identity(), {0, 0, -1}};
  const RelativePose T = unlevel(level_forward, levelling_rotation({8 * kDegree, 0}));
  const Eigen::Vector3d motion = -(T.R.transpose() * T.t);  // of the camera, in the first frame
  EXPECT_NEAR(motion.z(), std::cos(8 * kDegree), 1e-12);
  EXPECT_NEAR(motion.y(), std::sin(8 * kDegree), 1e-12);
}

}  // namespace
}  // namespace oneac
