#include "oneac/observations/sensor_mount.h"

#include "log_maker.h"

#include "oneac/geometry/camera_frame.h"
#include "oneac/geometry/leveling.h"

#include <gtest/gtest.h>
#include <mrpt/poses/CPose3D.h>

#include <limits>

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
