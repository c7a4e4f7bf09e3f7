#include "oneac/evaluation/georeference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace oneac {
namespace {

constexpr double kYaw = 2.1, kStart = 1.26e9;
const Eigen::Vector3d kShift{100.0, -40.0, 7.0};

/// A bend of 100 m at 10 m/s, ten frames a second.
Trajectory drive(double unit = 1.0) {
  Trajectory vehicle;
  for (int i = 0; i < 200; ++i) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    const double angle = 0.01 * i;
    pose.linear() = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    pose.translation() =
        Eigen::Vector3d(std::sin(angle), 1.0 - std::cos(angle), 0.0) * 100.0 / unit;
    vehicle.times.push_back(kStart + 0.1 * i);
    vehicle.poses.push_back(pose);
  }
  return vehicle;
}

std::vector<PositionFix> fixes(double noise) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0.0, noise);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(kYaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Trajectory truth = drive();
  std::vector<PositionFix> found;
  for (std::size_t i = 0; i < truth.poses.size(); i += 5) {
    Eigen::Vector3d enu = R * truth.poses[i].translation() + kShift;
    if (noise > 0.0) enu += Eigen::Vector3d(normal(random), normal(random), normal(random));
    found.push_back({truth.times[i], enu});
  }
  return found;
}

double yaw_of(const Georeference& found) {
  return std::atan2(found.enu_drive.R(1, 0), found.enu_drive.R(0, 0));
}

TEST(Georeference, JoinsADriveInMetresByTurnAndShift) {
  const GeoreferenceResult result = georeference(drive(), fixes(0.0), true);
  ASSERT_TRUE(result.found) << result.reason;
  EXPECT_NEAR(yaw_of(result.georeference), kYaw, 1e-9);
  EXPECT_LT((result.georeference.enu_drive.t - kShift).norm(), 1e-6);
  EXPECT_EQ(result.georeference.enu_drive.scale, 1.0);
  EXPECT_LT(result.georeference.max, 1e-6);
  const Trajectory moved = in_enu(drive(), result.georeference);
  EXPECT_LT((moved.poses[50].translation() - fixes(0.0)[10].enu).norm(), 1e-6);
}

TEST(Georeference, GivesADriveWithoutMetresTheScaleOfTheGps) {
  const GeoreferenceResult result = georeference(drive(4.0), fixes(0.0), false);
  ASSERT_TRUE(result.found) << result.reason;
  EXPECT_NEAR(result.georeference.enu_drive.scale, 4.0, 1e-9);
  EXPECT_LT(result.georeference.rms, 1e-6);
}

TEST(Georeference, TellsWhatMetresAreOffBy) {
  const GeoreferenceResult result = georeference(drive(1.1), fixes(0.0), true);
  ASSERT_TRUE(result.found) << result.reason;
  EXPECT_EQ(result.georeference.enu_drive.scale, 1.0);
  EXPECT_GT(result.georeference.rms, 2.0);
}

TEST(Georeference, IsNotPulledAwayByAWildFix) {
  std::vector<PositionFix> some = fixes(1.0);
  some[20].enu += Eigen::Vector3d(80.0, 0.0, 0.0);
  const GeoreferenceResult result = georeference(drive(), some, true);
  ASSERT_TRUE(result.found) << result.reason;
  EXPECT_NEAR(yaw_of(result.georeference), kYaw, 0.02);
  const Eigen::Vector3d off = result.georeference.enu_drive.t - kShift;
  EXPECT_LT(off.head<2>().norm(), 1.5);
  EXPECT_GT(result.georeference.max, 70.0);
  EXPECT_GT(result.georeference.yaw_sigma, 0.02);
}

TEST(Georeference, IsNotLiftedByAWildHeight) {
  auto wild = fixes(0.0);
  wild[20].enu.z() += 5000.0;
  const GeoreferenceResult result = georeference(drive(), wild, true);
  ASSERT_TRUE(result.found) << result.reason;
  EXPECT_NEAR(result.georeference.enu_drive.t.z(), kShift.z(), 1e-6);
}

TEST(Georeference, SaysWhyThereIsNone) {
  EXPECT_NE(georeference(drive(), {}, true).reason.find("no GPS position"), std::string::npos);
  std::vector<PositionFix> late = fixes(0.0);
  for (PositionFix& fix : late) fix.time_s += 3600.0;
  EXPECT_NE(georeference(drive(), late, true).reason.find("0 GPS positions"), std::string::npos);
  std::vector<PositionFix> standing = fixes(0.0);
  for (PositionFix& fix : standing) fix.enu = kShift;
  EXPECT_NE(georeference(drive(), standing, true).reason.find("scatter by 0.0 m"),
            std::string::npos);
  Trajectory parked = drive();
  for (Eigen::Isometry3d& pose : parked.poses) pose.setIdentity();
  standing[20].enu += Eigen::Vector3d(300.0, 0.0, 0.0);
  EXPECT_FALSE(georeference(parked, standing, true).found);
  EXPECT_FALSE(georeference(parked, standing, false).found);
  const GeoreferenceResult other = georeference(drive(), fixes(40.0), true);
  EXPECT_FALSE(other.found);
  EXPECT_NE(other.reason.find("do not follow"), std::string::npos) << other.reason;
}

}  // namespace
}  // namespace oneac
