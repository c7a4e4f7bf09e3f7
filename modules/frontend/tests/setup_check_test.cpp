#include "setup/setup_check.h"

#include "oneac/geometry/homography.h"
#include "oneac/geometry/levelling.h"
#include "oneac/observations/sensor_mount.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace oneac {
namespace {

constexpr double kHeight = 1.5;
constexpr int kSteps = 60;

CameraFrame frame_of(const MountAngles& believed) {
  CameraFrame frame;
  frame.camera.width = 1242;
  frame.camera.height = 375;
  frame.camera.fx = frame.camera.fy = 720.0;
  frame.camera.cx = 610.0;
  frame.camera.cy = 173.0;
  frame.T_vehicle_cam.linear() = mount_rotation(believed);
  return frame;
}

/// A step over a road, as a camera sees it that is really mounted like this.
TwoView seen_by(const MountAngles& real, const Eigen::Vector3d& way_of_vehicle) {
  SceneGenerator random(5);
  const Eigen::Matrix3d R_cam_vehicle = mount_rotation(real).transpose();
  const RelativePose T{Eigen::Matrix3d::Identity(), -(R_cam_vehicle * way_of_vehicle)};
  const Plane ground{-(R_cam_vehicle * Eigen::Vector3d::UnitZ()), kHeight};
  TwoView seen;
  seen.status = StepStatus::kOk;
  seen.focal_px = 720.0;
  seen.pose = {T.R, T.t.normalized()};
  const Eigen::Matrix3d H = plane_induced_homography(T, ground);
  for (int i = 0; i < 80; ++i) {
    // On the road, 4 to 12 m ahead.
    const Eigen::Vector3d X = R_cam_vehicle * Eigen::Vector3d(random.uniform(4.0, 12.0),
                                                              random.uniform(-2.0, 2.0), -kHeight);
    if (!(X.z() > 0.1)) continue;
    const auto ac = correspondence_from_homography(H, X.head<2>() / X.z());
    if (!ac) continue;
    seen.pair.correspondences.emplace_back();
    static_cast<AffineCorrespondence&>(seen.pair.correspondences.back()) = *ac;
  }
  seen.inliers.assign(seen.pair.size(), true);
  seen.inlier_count = seen.pair.size();
  return seen;
}

Eigen::Matrix3d levelling(const MountAngles& believed) {
  return levelling_rotation(tilt_from_mounting(mount_rotation(believed)));
}

/// What is said of a straight drive with a camera believed to be mounted like this.
std::vector<std::string> faults(const MountAngles& believed, const MountAngles& real) {
  SetupCheck setup;
  setup.start(frame_of(believed));
  const TwoView seen = seen_by(real, {1.0, 0.0, 0.0});
  for (int i = 0; i < kSteps; ++i) setup.follow(seen, levelling(believed));
  EXPECT_EQ(setup.metric_allowed(), setup.faults().empty());
  return setup.faults();
}

MountAngles rolled(double deg) {
  return {deg, 3.0, 0.0};
}

TEST(SetupCheck, SaysNothingOfMountsThatAreAsBelieved) {
  for (const MountAngles& mount : {rolled(0.0), rolled(180.0), rolled(90.0), rolled(-90.0),
                                   MountAngles{0.0, 3.0, 25.0}, MountAngles{0.0, 3.0, -40.0}}) {
    const auto found = faults(mount, mount);
    EXPECT_TRUE(found.empty()) << mount.roll_right_deg << ' ' << mount.yaw_left_deg << ": "
                               << found.front();
  }
}

TEST(SetupCheck, FindsTheRoadWhereItShouldNotBe) {
  struct Case {
    double roll;
    const char* cure;
  };
  for (const Case& c : {Case{180.0, "--mount-roll 180"}, Case{90.0, "--mount-roll 90"},
                        Case{-90.0, "--mount-roll -90"}}) {
    const auto found = faults({0.0, 0.0, 0.0}, {c.roll, 0.0, 0.0});
    ASSERT_EQ(found.size(), 1U) << c.roll;
    EXPECT_NE(found[0].find(c.cure), std::string::npos) << found[0];
    EXPECT_NE(found[0].find("nothing is in metres"), std::string::npos) << found[0];
  }
}

/// What an upright camera sees that passes a wall at its right, from the ground up.
TwoView beside_wall(double distance, double height_of_wall) {
  SceneGenerator random(7);
  const RelativePose T{Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.0, 0.0, -1.0)};
  const Eigen::Matrix3d H = plane_induced_homography(T, {Eigen::Vector3d::UnitX(), distance});
  TwoView seen;
  seen.status = StepStatus::kOk;
  seen.focal_px = 720.0;
  seen.pose = T;
  for (int i = 0; i < 80; ++i) {
    const Eigen::Vector3d X(distance, kHeight - random.uniform(0.0, height_of_wall),
                            distance * random.uniform(1.5, 5.0));
    const auto ac = correspondence_from_homography(H, X.head<2>() / X.z());
    if (!ac) continue;
    seen.pair.correspondences.emplace_back();
    static_cast<AffineCorrespondence&>(seen.pair.correspondences.back()) = *ac;
  }
  seen.inliers.assign(seen.pair.size(), true);
  seen.inlier_count = seen.pair.size();
  return seen;
}

TEST(SetupCheck, TakesNoWallForARoadWhereTheRoadShowsNothing) {
  for (const double distance : {2.0, 4.0, 15.0}) {
    for (const double height_of_wall : {0.9, 3.0, 10.0}) {
      SetupCheck setup;
      setup.start(frame_of({}));
      const TwoView seen = beside_wall(distance, height_of_wall);
      for (int i = 0; i < kSteps; ++i) setup.follow(seen, levelling({}));
      EXPECT_TRUE(setup.metric_allowed()) << distance << ' ' << height_of_wall;
    }
  }
}

TEST(SetupCheck, IsNotMisledByATunnelOnceTheRoadWasSeen) {
  SetupCheck setup;
  setup.start(frame_of({}));
  const TwoView road = seen_by({}, {1.0, 0.0, 0.0});
  const TwoView ceiling = seen_by(rolled(180.0), {1.0, 0.0, 0.0});
  for (int i = 0; i < kSteps; ++i) setup.follow(road, levelling({}));
  for (int i = 0; i < 8 * kSteps; ++i) setup.follow(ceiling, levelling({}));
  EXPECT_TRUE(setup.metric_allowed());
}

TEST(SetupCheck, TakesBackWhatItSaidInATunnel) {
  SetupCheck setup;
  setup.start(frame_of({}));
  const TwoView road = seen_by({}, {1.0, 0.0, 0.0});
  const TwoView ceiling = seen_by(rolled(180.0), {1.0, 0.0, 0.0});
  for (int i = 0; i < kSteps / 2; ++i) setup.follow(ceiling, levelling({}));
  EXPECT_FALSE(setup.metric_allowed());
  for (int i = 0; i < 8 * kSteps; ++i) setup.follow(road, levelling({}));
  EXPECT_TRUE(setup.metric_allowed());
}

TEST(SetupCheck, DirectionsAllAroundAreNoMount) {
  SetupCheck setup;
  setup.start(frame_of({}));
  for (int i = 0; i < 4 * kSteps; ++i) {
    const double angle = 2.4 * i;  // the golden angle: even all around
    setup.follow(seen_by({}, {std::cos(angle), std::sin(angle), 0.0}), levelling({}));
  }
  for (const std::string& fault : setup.faults()) {
    EXPECT_EQ(fault.find("off the direction"), std::string::npos) << fault;
  }
}

TEST(SetupCheck, FindsTravelOffTheBelievedHeading) {
  const auto found = faults({0.0, 0.0, 0.0}, {0.0, 0.0, 40.0});
  ASSERT_FALSE(found.empty());
  EXPECT_NE(found[0].find("40° off"), std::string::npos) << found[0];
  EXPECT_NE(found[0].find("--mount-yaw"), std::string::npos) << found[0];
  EXPECT_FALSE(faults({0.0, 0.0, 90.0}, {0.0, 0.0, 20.0}).empty());
}

TEST(SetupCheck, ACameraThatLooksAsideNeedsItsPitch) {
  const auto found = faults({0.0, 0.0, 90.0}, {0.0, 0.0, 90.0});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].find("--mount-pitch"), std::string::npos) << found[0];
  for (const MountAngles& mount : {MountAngles{0.0, 3.0, 90.0}, MountAngles{0.0, 0.0, 180.0}}) {
    EXPECT_TRUE(faults(mount, mount).empty()) << mount.yaw_left_deg;
  }
}

TEST(SetupCheck, TheCureKeepsPitchAndYawThatTheLogTells) {
  const auto found = faults({0.0, 8.2, 10.0}, {180.0, 8.2, 10.0});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].find("--mount-roll 180 --mount-pitch 8.2 --mount-yaw 10"), std::string::npos)
      << found[0];
}

TEST(SetupCheck, AllowsBacking) {
  SetupCheck setup;
  setup.start(frame_of({}));
  const TwoView seen = seen_by({}, {-1.0, 0.0, 0.0});
  for (int i = 0; i < kSteps; ++i) setup.follow(seen, levelling({}));
  EXPECT_TRUE(setup.metric_allowed());
}

TEST(SetupCheck, FindsTwoCamerasUnderOneLabel) {
  SetupCheck setup;
  setup.start(frame_of({}));
  for (int i = 0; i < kSteps; ++i) {
    setup.follow(seen_by({}, {0.5, i % 2 == 0 ? 0.5 : -0.5, 0.0}), levelling({}));
  }
  ASSERT_FALSE(setup.faults().empty());
  EXPECT_NE(setup.faults()[0].find("two cameras under one label"), std::string::npos);
}

TEST(SetupCheck, FindsTwoCamerasThoughEverySecondStepIsTakenForBacking) {
  SetupCheck setup;
  setup.start(frame_of({}));
  for (int i = 0; i < kSteps; ++i) {
    setup.follow(seen_by({}, {i % 2 == 0 ? 0.5 : -0.5, 0.25, 0.0}), levelling({}));
  }
  ASSERT_FALSE(setup.faults().empty());
  EXPECT_NE(setup.faults()[0].find("two cameras under one label"), std::string::npos);
}

TEST(SetupCheck, SaysNothingAfterAFewSteps) {
  SetupCheck setup;
  setup.start(frame_of({}));
  const TwoView seen = seen_by({0.0, 0.0, 40.0}, {1.0, 0.0, 0.0});
  for (int i = 0; i < 15; ++i) setup.follow(seen, levelling({}));
  EXPECT_TRUE(setup.metric_allowed());
}

TEST(SetupCheck, LooksAtNothingThatDidNotMove) {
  SetupCheck setup;
  setup.start(frame_of({}));
  TwoView seen = seen_by({0.0, 0.0, 40.0}, {1.0, 0.0, 0.0});
  for (const StepStatus status : {StepStatus::kNoMotion, StepStatus::kPredicted}) {
    seen.status = status;
    for (int i = 0; i < kSteps; ++i) setup.follow(seen, levelling({}));
  }
  EXPECT_TRUE(setup.metric_allowed());
}

TEST(SetupCheck, TakesMetresFromAnImpossibleCalibration) {
  CameraFrame frame = frame_of({});
  frame.camera.fx = frame.camera.fy = 5.0;
  SetupCheck setup;
  setup.start(frame);
  ASSERT_EQ(setup.faults().size(), 1U);
  EXPECT_NE(setup.faults()[0].find("--calibration"), std::string::npos);
  StepLength length;
  length.length = 1.0;
  length.sigma = 0.01;
  length.metric = true;
  EXPECT_FALSE(setup.checked_after(length).metric);
  EXPECT_EQ(setup.checked_after(length).length, 1.0);
  EXPECT_EQ(setup.checked_after(length).sigma, 0.0);
  ScaleCorrection correction;
  correction.metric = true;
  EXPECT_FALSE(setup.checked(correction).metric);
  setup.start(frame_of({}));
  EXPECT_TRUE(setup.checked_after(length).metric);
}

TEST(SetupCheck, AccusesStampsOrHeightWhenNoCarDrivesAsFast) {
  StepLength right, flying;
  right.length = 1.0;
  right.sigma = 0.01;
  right.metric = true;
  flying.refused = flying.too_fast = true;
  const TwoView seen = seen_by({}, {1.0, 0.0, 0.0});
  const auto drive = [&](int steps, int flies_every) {
    SetupCheck setup;
    setup.start(frame_of({}));
    for (int i = 1; i <= steps; ++i) {
      static_cast<void>(setup.checked_after(i % flies_every == 0 ? flying : right));
      setup.follow(seen, levelling({}));
    }
    return setup;
  };
  const SetupCheck wrong = drive(100, 2);
  ASSERT_EQ(wrong.faults().size(), 1U);
  EXPECT_NE(wrong.faults()[0].find("250 km/h"), std::string::npos);
  EXPECT_NE(wrong.faults()[0].find("--camera-height"), std::string::npos);
  EXPECT_TRUE(drive(400, 20).metric_allowed()) << "now and then a length is wrong";
  EXPECT_TRUE(drive(8, 2).metric_allowed()) << "too early";
}

}  // namespace
}  // namespace oneac
