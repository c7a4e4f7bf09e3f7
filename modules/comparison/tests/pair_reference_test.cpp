#include "oneac/comparison/pair_reference.h"

#include "oneac/geometry/angular_errors.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// A GPS at 1 Hz on a road that turns by `rate` [rad/s], courses with noise.
VehicleReference turning(double rate, double sigma) {
  SceneGenerator random(7);
  VehicleReference vehicle;
  for (int i = 0; i < 200; ++i) {
    GpsFix fix;
    fix.time_s = i;
    fix.speed = 10.0;
    fix.course = 0.3 - rate * i + random.normal(sigma);  // a left turn lowers the course
    vehicle.gps.push_back(fix);
  }
  return vehicle;
}

TEST(PairReference, TakesPosesByIndexWithoutTimes) {
  Trajectory poses;
  for (int i = 0; i < 3; ++i) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation() << 0, 0, 2.0 * i;
    poses.poses.push_back(T);
  }
  const PairReference reference(poses, {{0, 10.0}, {2, 12.0}});
  const auto motion = reference.motion({0, 10.0}, {2, 12.0});
  ASSERT_TRUE(motion);
  EXPECT_TRUE(motion->t.isApprox(Eigen::Vector3d(0, 0, -4)));
  EXPECT_FALSE(reference.motion({0, 10.0}, {3, 13.0}));
}

TEST(PairReference, TurnsALeftTurnOfTheGpsIntoTheCamerasYaw) {
  const double rate = 5.0 * kDegree;
  const PairReference reference(turning(rate, 0.0), Eigen::Matrix3d::Identity());
  const auto motion = reference.motion({0, 10.0}, {1, 10.5});
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->t.norm(), 0.0);
  // Positive yaw turns right (docs/conventions.md).
  const Eigen::Matrix3d left = yaw_rotation(std::cos(0.5 * rate), -std::sin(0.5 * rate));
  EXPECT_LT(rotation_error(motion->R, left), 1e-9);
}

TEST(PairReference, KnowsNothingWithoutGps) {
  const PairReference reference(VehicleReference{}, Eigen::Matrix3d::Identity());
  EXPECT_FALSE(reference.motion({0, 1.0}, {1, 2.0}));
}

TEST(GpsQuality, FindsTheNoiseOfTheCourses) {
  for (const double sigma_deg : {0.2, 1.0}) {
    const auto quality = gps_quality(turning(2.0 * kDegree, sigma_deg * kDegree), 0.1);
    ASSERT_TRUE(quality);
    EXPECT_NEAR(quality->course_sigma / kDegree, sigma_deg, 0.2 * sigma_deg);
    // A tenth of the interval between fixes sees a tenth of the difference of two courses.
    EXPECT_NEAR(quality->heading_sigma, 0.1 * std::sqrt(2.0) * quality->course_sigma, 1e-12);
  }
}

TEST(GpsQuality, DoesNotTakeASteadyTurnForNoise) {
  const auto quality = gps_quality(turning(10.0 * kDegree, 0.0), 1.0);
  ASSERT_TRUE(quality);
  EXPECT_LT(quality->course_sigma, 1e-6);
}

TEST(GpsQuality, ComparesWithTheGyroscopeWithoutItsBias) {
  const double rate = 3.0 * kDegree;
  VehicleReference vehicle = turning(rate, 0.0);
  EXPECT_FALSE(gps_against_gyro(vehicle, {{0, 20.0}, {1, 21.0}}));
  for (int i = 0; i < 2000; ++i) {
    ImuSample sample;
    sample.time_s = 0.1 * i;
    sample.angular_rate = Eigen::Vector3d(0.0, 0.0, rate + 0.01);
    vehicle.imu.push_back(sample);
  }
  std::vector<ImageMoment> images;
  for (std::size_t i = 0; i < 50; ++i) images.push_back({i, 20.0 + 0.5 * static_cast<double>(i)});
  const auto rms = gps_against_gyro(vehicle, images);
  ASSERT_TRUE(rms);
  EXPECT_LT(*rms, 1e-6);
  for (std::size_t i = 0; i < vehicle.imu.size(); ++i) {
    vehicle.imu[i].angular_rate->z() += i / 5 % 2 == 0 ? 0.02 : -0.02;  // half a second each
  }
  EXPECT_GT(*gps_against_gyro(vehicle, images), 0.003);
}

}  // namespace
}  // namespace oneac
