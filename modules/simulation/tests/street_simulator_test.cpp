#include "oneac/simulation/street_simulator.h"

#include "oneac/geometry/levelling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <stdexcept>
#include <vector>

namespace oneac {
namespace {

constexpr double kDegree = 0.017453292519943295;

SimulationOptions small_drive() {
  SimulationOptions options;
  options.width_px = 320;
  options.height_px = 240;
  options.focal_px = 250.0;
  return options;
}

/// Building the street takes a second: one for all tests that only look.
const StreetSimulator& shared_drive() {
  static const StreetSimulator simulator(small_drive());
  return simulator;
}

std::vector<std::uint8_t> bytes(const GreyImage& image) {
  const std::uint8_t* first = image.view().data;
  return {first, first + static_cast<std::ptrdiff_t>(image.width()) * image.height()};
}

double bilinear(const GreyImage& image, const Eigen::Vector2d& u) {
  const int x = static_cast<int>(u.x());
  const int y = static_cast<int>(u.y());
  const double a = u.x() - x;
  const double b = u.y() - y;
  return (1 - b) * ((1 - a) * image.row(y)[x] + a * image.row(y)[x + 1]) +
         b * ((1 - a) * image.row(y + 1)[x] + a * image.row(y + 1)[x + 1]);
}

/// Mean absolute grey difference of the points that two cameras both see, found through the truth;
/// the second image is read as if its camera stood at `assumed`.
double warp_error(const StreetSimulator& drive, const Eigen::Isometry3d& T_world_1,
                  const Eigen::Isometry3d& T_world_2, const Eigen::Isometry3d& assumed) {
  const GreyImage first = drive.render(T_world_1);
  const GreyImage second = drive.render(T_world_2);
  const PinholeCamera camera = drive.camera();
  double sum = 0.0;
  int count = 0;
  for (int v = 4; v < camera.height; v += 3) {
    for (int u = 4; u < camera.width; u += 3) {
      const auto X = drive.surface_point(T_world_1, {u, v});
      if (!X || (*X - T_world_1.translation()).norm() > 25.0) continue;
      const Eigen::Vector3d X2 = assumed.inverse() * *X;
      if (X2.z() < 0.5) continue;
      const Eigen::Vector2d u2 = camera.project(X2.hnormalized());
      if (u2.minCoeff() < 1 || u2.x() > camera.width - 2 || u2.y() > camera.height - 2) continue;
      const auto seen = drive.surface_point(assumed, u2);
      if (!seen || (*seen - *X).norm() > 0.05) continue;  // hidden in the second view
      sum += std::abs(bilinear(second, u2) - first.row(v)[u]);
      ++count;
    }
  }
  EXPECT_GT(count, 500);
  return sum / std::max(count, 1);
}

TEST(StreetSimulator, SameSeedSameBytesOnAnyNumberOfThreads) {
  const StreetSimulator again(small_drive());
  std::vector<std::future<GreyImage>> threads;
  for (std::size_t i = 0; i < 4; ++i) {
    threads.push_back(std::async(std::launch::async, [&again, i] { return again.frame(i).left; }));
  }
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(bytes(threads[i].get()), bytes(shared_drive().frame(i).left)) << i;
  }
}

TEST(StreetSimulator, AnotherSeedGivesAnotherStreet) {
  SimulationOptions options = small_drive();
  options.seed = 2;
  EXPECT_NE(bytes(StreetSimulator(options).frame(0).left), bytes(shared_drive().frame(0).left));
}

TEST(StreetSimulator, LengthOfTheDriveDoesNotChangeItsStart) {
  SimulationOptions options = small_drive();
  options.frames = 12;
  const StreetSimulator brief(options);
  for (std::size_t i : {0U, 11U}) {
    EXPECT_TRUE(brief.state(i).T_world_cam.isApprox(shared_drive().state(i).T_world_cam, 1e-12));
  }
}

TEST(StreetSimulator, ImagesAgreeWithTheTruePoses) {
  const StreetSimulator& drive = shared_drive();
  for (std::size_t i : {5U, 60U, 100U, 200U}) {
    const Eigen::Isometry3d T_1 = drive.state(i).T_world_cam;
    const Eigen::Isometry3d T_2 = drive.state(i + 1).T_world_cam;
    Eigen::Isometry3d wrong = T_2;
    wrong.rotate(Eigen::AngleAxisd(1.0 * kDegree, Eigen::Vector3d::UnitY()));
    const double at_truth = warp_error(drive, T_1, T_2, T_2);
    EXPECT_LT(at_truth, 5.0) << i;
    EXPECT_GT(warp_error(drive, T_1, T_2, wrong), 1.8 * at_truth) << i;
  }
}

TEST(StreetSimulator, FarSurfacesDoNotFlicker) {
  const StreetSimulator& drive = shared_drive();
  const Eigen::Isometry3d T = drive.state(0).T_world_cam;
  Eigen::Isometry3d nudged = T;
  nudged.translation().x() += 0.02;
  // 2 cm move a point 20 m ahead by 0.1 px at most: an aliased texture would change its grey by
  // tens.
  const GreyImage a = drive.render(T);
  const GreyImage b = drive.render(nudged);
  double sum = 0.0;
  int count = 0;
  for (int v = 0; v < a.height(); ++v) {
    for (int u = 0; u < a.width(); ++u) {
      const auto X = drive.surface_point(T, {u, v});
      if (!X || (*X - T.translation()).norm() < 20.0) continue;
      sum += std::abs(int{a.row(v)[u]} - int{b.row(v)[u]});
      ++count;
    }
  }
  ASSERT_GT(count, 1000);
  EXPECT_LT(sum / count, 2.0);
}

TEST(StreetSimulator, ImagesAreRichInTexture) {
  const GreyImage image = shared_drive().frame(20).left;
  int strong = 0;
  int ground_strong = 0;
  for (int v = 1; v < image.height() - 1; ++v) {
    for (int u = 1; u < image.width() - 1; ++u) {
      const int gx = image.row(v)[u + 1] - image.row(v)[u - 1];
      const int gy = image.row(v + 1)[u] - image.row(v - 1)[u];
      if (gx * gx + gy * gy < 200) continue;
      ++strong;
      if (v > image.height() * 3 / 4) ++ground_strong;
    }
  }
  EXPECT_GT(strong, image.width() * image.height() / 12);
  EXPECT_GT(ground_strong, image.width() * image.height() / 4 / 12);
}

TEST(StreetSimulator, MountingHasTheConfiguredTiltAndHeight) {
  SimulationOptions options = small_drive();
  options.frames = 1;
  options.camera_tilt_deg = 7.5;
  options.camera_height_m = 1.65;
  const StreetSimulator drive(options);
  const Tilt tilt = tilt_from_mounting(drive.T_vehicle_cam().linear());
  EXPECT_NEAR(tilt.pitch_up, 7.5 * kDegree, 1e-12);
  EXPECT_NEAR(tilt.roll_right, 0.0, 1e-12);
  EXPECT_NEAR(drive.T_vehicle_cam().translation().z(), 1.65, 1e-12);
}

TEST(StreetSimulator, AFlatSuspensionLeavesTheCameraAtItsTilt) {
  SimulationOptions options = small_drive();
  options.frames = 2;
  options.suspension_pitch_deg = 0.0;
  options.suspension_roll_deg = 0.0;
  const StreetSimulator drive(options);
  const Eigen::Isometry3d& T = drive.state(0).T_world_cam;
  const Tilt tilt = tilt_from_mounting(T.linear());
  EXPECT_NEAR(tilt.pitch_up, options.camera_tilt_deg * kDegree, 1e-9);
  EXPECT_NEAR(T.translation().z(), options.camera_height_m, 1e-9);
  // The horizon: one ray just below the horizontal meets the ground where it should.
  const auto X = drive.surface_point(T, {159.5, 239.0});
  ASSERT_TRUE(X.has_value());
  const double below = std::atan(119.5 / 250.0) - options.camera_tilt_deg * kDegree;
  EXPECT_NEAR(X->x() - T.translation().x(), options.camera_height_m / std::tan(below), 1e-6);
}

TEST(StreetSimulator, SuspensionPitchesATenthOfADegreeBetweenFrames) {
  const StreetSimulator& drive = shared_drive();
  std::vector<double> changes;
  for (std::size_t i = 1; i < 100; ++i) {
    const double before = tilt_from_mounting(drive.state(i - 1).T_world_cam.linear()).pitch_up;
    const double after = tilt_from_mounting(drive.state(i).T_world_cam.linear()).pitch_up;
    changes.push_back(std::abs(after - before) / kDegree);
  }
  std::sort(changes.begin(), changes.end());
  EXPECT_GT(changes[changes.size() / 2], 0.03);
  EXPECT_LT(changes.back(), 1.0);
}

TEST(StreetSimulator, AStopReallyStops) {
  const StreetSimulator& drive = shared_drive();
  int standing = 0;
  for (std::size_t i = 1; i < drive.size(); ++i) {
    if (drive.state(i).speed_mps != 0.0 || drive.state(i - 1).speed_mps != 0.0) continue;
    ++standing;
    const Eigen::Isometry3d& a = drive.state(i - 1).T_world_vehicle;
    EXPECT_EQ(a.translation(), drive.state(i).T_world_vehicle.translation());
  }
  EXPECT_GE(standing, 28);  // three seconds
}

TEST(StreetSimulator, TheDefaultDriveTurnsAndStops) {
  const StreetSimulator& drive = shared_drive();
  const Eigen::Matrix3d first = drive.state(0).T_world_vehicle.linear();
  double largest_turn = 0.0;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    const double c = first.col(0).dot(drive.state(i).T_world_vehicle.linear().col(0));
    largest_turn = std::max(largest_turn, std::acos(std::clamp(c, -1.0, 1.0)));
  }
  EXPECT_GT(largest_turn, 88.0 * kDegree);
}

TEST(StreetSimulator, AnImageShownTwiceHasNoiseOfItsOwn) {
  SimulationOptions options = small_drive();
  options.repeat_every = 5;
  const StreetSimulator drive(options);
  for (std::size_t i = 1; i < 12; ++i) {
    SCOPED_TRACE(i);
    const Eigen::Vector3d step =
        drive.state(i).T_world_cam.translation() - drive.state(i - 1).T_world_cam.translation();
    EXPECT_NEAR(drive.state(i).time_s, static_cast<double>(i) / options.fps, 1e-12);
    if (i % 5 == 4) {
      EXPECT_EQ(step.norm(), 0.0);
    } else {
      EXPECT_GT(step.norm(), 0.3) << "of a camera at four fifths of the rate";
    }
  }
  EXPECT_NE(bytes(drive.frame(3).left), bytes(drive.frame(4).left));
}

TEST(StreetSimulator, RightImageIsShiftedByTheDisparity) {
  SimulationOptions options = small_drive();
  options.frames = 1;
  options.stereo = true;
  options.image_noise = 0.0;
  const StreetSimulator drive(options);
  const SimulatedFrame frame = drive.frame(0);
  const Eigen::Translation3d shift(options.baseline_m, 0.0, 0.0);
  EXPECT_EQ(bytes(frame.right), bytes(drive.render(frame.state.T_world_cam * shift)));
  EXPECT_EQ(bytes(frame.left), bytes(drive.render(frame.state.T_world_cam)));
}

TEST(StreetSimulator, MonoHasNoRightImage) {
  EXPECT_TRUE(shared_drive().frame(0).right.empty());
}

TEST(StreetSimulator, ImuAgreesWithThePoses) {
  const StreetSimulator& drive = shared_drive();
  const std::vector<SimulatedImu> imu = drive.imu();
  double yaw = 0.0;
  const double end = drive.state(drive.size() - 1).time_s;
  for (const SimulatedImu& reading : imu) {
    yaw += reading.angular_rate_radps.z() * 0.01;
    EXPECT_NEAR(reading.specific_force_mps2.z(), 9.8, 0.4);
  }
  EXPECT_NEAR(imu.back().time_s, end, 0.011);
  const Eigen::Vector3d ahead = drive.state(drive.size() - 1).T_world_vehicle.linear().col(0);
  EXPECT_NEAR(yaw, std::atan2(ahead.y(), ahead.x()), 2.0 * kDegree);
}

TEST(StreetSimulator, GpsAgreesWithThePoses) {
  const StreetSimulator& drive = shared_drive();
  for (const SimulatedGps& fix : drive.gps()) {
    const auto i = static_cast<std::size_t>(std::lround(fix.time_s * drive.options().fps));
    if (i >= drive.size()) continue;
    const SimulatedState state = drive.state(i);
    const Eigen::Vector3d ahead = state.T_world_vehicle.linear().col(0);
    EXPECT_LT((fix.position_m - state.T_world_vehicle.translation()).norm(), 2.0);
    EXPECT_NEAR(fix.speed_mps, state.speed_mps, 0.3);
    const double course = fix.course_deg * kDegree;  // clockwise from north
    EXPECT_GT(ahead.x() * std::sin(course) + ahead.y() * std::cos(course), std::cos(2.0 * kDegree));
  }
}

TEST(StreetSimulator, GpsCoversTheWholeDrive) {
  const StreetSimulator& drive = shared_drive();
  const double end = drive.state(drive.size() - 1).time_s;
  EXPECT_EQ(drive.gps().front().time_s, 0.0);
  EXPECT_GE(drive.gps().back().time_s, end);
  EXPECT_LT(drive.gps().back().time_s, end + 1.0);
}

TEST(StreetSimulator, RefusesFramesBeyondItsEnd) {
  EXPECT_THROW((void)shared_drive().frame(shared_drive().size()), std::out_of_range);
}

TEST(StreetSimulator, WheelsCountTheWayWithTheErrorOfTheirSize) {
  SimulationOptions options;
  options.frames = 60;
  options.stop_s = 0.0;
  for (const double percent : {0.0, 4.0}) {
    options.wheel_error_percent = percent;
    const StreetSimulator drive(options);
    double way = 0.0, told = 0.0;
    for (std::size_t i = 1; i < drive.size(); ++i) {
      way += (drive.state(i).T_world_vehicle.translation() -
              drive.state(i - 1).T_world_vehicle.translation())
                 .norm();
    }
    const auto wheels = drive.wheels();
    for (std::size_t i = 1; i < wheels.size(); ++i) {
      told += (wheels[i].position_m - wheels[i - 1].position_m).norm();
    }
    EXPECT_NEAR(told / way, 1.0 + percent / 100.0, 0.005);
    EXPECT_NEAR(wheels[1].time_s, 0.02, 1e-12);
    EXPECT_GT(wheels.back().position_m.x(), 10.0) << "ahead at the start";
  }
}

}  // namespace
}  // namespace oneac
