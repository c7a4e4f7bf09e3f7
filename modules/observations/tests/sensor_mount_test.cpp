#include "oneac/observations/sensor_mount.h"

#include "log_maker.h"

#include "oneac/geometry/camera_frame.h"
#include "oneac/geometry/levelling.h"

#include <gtest/gtest.h>
#include <mrpt/poses/CPose3D.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace oneac {
namespace {

constexpr double kDegree = M_PI / 180.0;

Eigen::Isometry3d pose(double yaw_deg, double pitch_deg, double roll_deg) {
  const mrpt::poses::CPose3D p(0.785, 0, 0.273, yaw_deg * kDegree, pitch_deg * kDegree,
                               roll_deg * kDegree);
  Eigen::Isometry3d T(p.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen());
  return T;
}

TEST(SensorMount, RecognisesTheOpticalConvention) {
  const auto mount = mount_from_sensor_pose(pose(-90, 0, -90));
  EXPECT_EQ(mount.convention, MountConvention::optical);
  EXPECT_TRUE(
      mount.T_vehicle_cam.linear().isApprox(CameraFrame::forward_looking_mount().linear(), 1e-12));
}

TEST(SensorMount, RecognisesTheXForwardConvention) {
  const auto mount = mount_from_sensor_pose(pose(0, 0, 0));
  EXPECT_EQ(mount.convention, MountConvention::x_forward);
  EXPECT_TRUE(
      mount.T_vehicle_cam.linear().isApprox(CameraFrame::forward_looking_mount().linear(), 1e-12));
}

TEST(SensorMount, NegativePitchOfAnXForwardPoseIsATiltUpward) {
  const auto mount = mount_from_sensor_pose(pose(0, -8.2, 0));
  EXPECT_EQ(mount.convention, MountConvention::x_forward);
  const Tilt tilt = tilt_from_mounting(mount.T_vehicle_cam.linear());
  EXPECT_NEAR(tilt.pitch_up, 8.2 * kDegree, 1e-9);
  EXPECT_NEAR(tilt.roll_right, 0.0, 1e-9);
  EXPECT_NEAR(mount.T_vehicle_cam.translation().x(), 0.785, 1e-12);
}

Eigen::Isometry3d stored(const MountAngles& angles, MountConvention convention) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = mount_rotation(angles);
  if (convention == MountConvention::x_forward) {
    T.linear() = T.linear() * CameraFrame::forward_looking_mount().linear().transpose();
  }
  return T;
}

TEST(SensorMount, RecognisesCamerasThatAreRolledOrLookElsewhere) {
  for (const MountAngles& angles : {MountAngles{180.0, 5.0, 0.0}, MountAngles{-180.0, -5.0, 180.0},
                                    MountAngles{0.0, 5.0, 180.0}, MountAngles{0.0, 10.0, 90.0},
                                    MountAngles{0.0, -10.0, -90.0}, MountAngles{3.0, 5.0, 30.0}}) {
    for (const auto convention : {MountConvention::optical, MountConvention::x_forward}) {
      const SensorMount mount = mount_from_sensor_pose(stored(angles, convention));
      EXPECT_EQ(mount.convention, convention)
          << angles.roll_right_deg << ' ' << angles.yaw_left_deg;
      EXPECT_TRUE(mount.sure);
      EXPECT_TRUE(mount.T_vehicle_cam.linear().isApprox(mount_rotation(angles), 1e-9));
    }
  }
  for (const double roll : {90.0, -90.0}) {
    const SensorMount mount =
        mount_from_sensor_pose(stored({roll, 5.0, 0.0}, MountConvention::optical));
    EXPECT_EQ(mount.convention, MountConvention::optical) << roll;
    EXPECT_TRUE(mount.sure);
  }
}

TEST(SensorMount, IsNotSureOfACameraThatBothReadingsMakeUnusual) {
  const SensorMount mount =
      mount_from_sensor_pose(stored({135.0, 0.0, 45.0}, MountConvention::optical));
  EXPECT_FALSE(mount.sure);
  EXPECT_TRUE(
      mount_from_sensor_pose(stored({135.0, 0.0, 45.0}, MountConvention::optical), "optical").sure);
}

TEST(SensorMount, AnglesTurnTheCameraAsTheyAreNamed) {
  const Eigen::Vector3d ahead = mount_rotation({0.0, 10.0, 0.0}).col(2);
  EXPECT_NEAR(ahead.z(), std::sin(10.0 * kDegree), 1e-12) << "looks above the horizon";
  EXPECT_TRUE(mount_rotation({0.0, 0.0, 90.0}).col(2).isApprox(Eigen::Vector3d::UnitY(), 1e-12))
      << "looks to the left";
  EXPECT_TRUE(mount_rotation({90.0, 0.0, 0.0}).col(0).isApprox(-Eigen::Vector3d::UnitZ(), 1e-12))
      << "its right side hangs down";
  EXPECT_TRUE(mount_rotation({180.0, 0.0, 0.0}).col(1).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
}

TEST(SensorMount, AnglesBeyondTheirBoundsAreRefused) {
  EXPECT_NO_THROW((MountAngles{-180.0, 90.0, 360.0}.validate()));
  EXPECT_THROW((MountAngles{361.0, 0.0, 0.0}.validate()), std::invalid_argument);
  EXPECT_THROW((MountAngles{0.0, -91.0, 0.0}.validate()), std::invalid_argument);
  EXPECT_THROW((MountAngles{0.0, 0.0, std::nan("")}.validate()), std::invalid_argument);
}

TEST(SensorMount, ObeysAGivenConvention) {
  EXPECT_EQ(mount_from_sensor_pose(pose(0, 0, 0), "optical").convention, MountConvention::optical);
  EXPECT_EQ(mount_from_sensor_pose(pose(-90, 0, -90), "x_forward").convention,
            MountConvention::x_forward);
}

TEST(SensorMount, RefusesUnknownConventionsAndPosesThatAreNotFinite) {
  EXPECT_NE(test::input_error([] {
              static_cast<void>(mount_from_sensor_pose(pose(0, 0, 0), "sideways"));
            }).find("auto, optical or x_forward"),
            std::string::npos);
  auto broken = pose(0, 0, 0);
  broken.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(static_cast<void>(mount_from_sensor_pose(broken)), InputError);
}

}  // namespace
}  // namespace oneac
