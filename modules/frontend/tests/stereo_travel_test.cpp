#include "scale/stereo_travel.h"

#include <gtest/gtest.h>

#include <random>

namespace oneac {
namespace {

constexpr double kFocal = 700.0;

/// Points about a car that went `metres` ahead, depths known to one per cent, tracks to 0.2 px.
TwoView seen_over(double metres, std::size_t points, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> side(-6.0, 6.0), up(-2.0, 1.5), depth(4.0, 25.0);
  std::normal_distribution<double> noise(0.0, 1.0);
  TwoView seen;
  seen.status = metres > 0.0 ? StepStatus::kOk : StepStatus::kNoMotion;
  seen.focal_px = kFocal;
  if (metres > 0.0) seen.pose.t = Eigen::Vector3d(0.0, 0.0, -1.0);
  for (std::size_t i = 0; i < points; ++i) {
    const Eigen::Vector3d X(side(random), up(random), depth(random));
    Correspondence ac;
    ac.x2 = X.hnormalized();
    ac.x1 = (X + Eigen::Vector3d(0.0, 0.0, metres)).hnormalized();
    ac.point_sigma = 0.2 / kFocal;
    ac.x2 += ac.point_sigma * Eigen::Vector2d(noise(random), noise(random));
    ac.depth = MeasuredDepth{X.z() * (1.0 + 0.01 * noise(random)), 0.01};
    seen.pair.correspondences.push_back(ac);
  }
  seen.inliers.assign(points, true);
  return seen;
}

const Eigen::Vector3d kAhead(0.0, 0.0, -1.0);

TEST(StereoTravel, TellsTheLengthOfAStepWithinItsSigma) {
  for (const double metres : {0.05, 0.3, 1.5}) {
    const auto travel = stereo_travel(seen_over(metres, 100), kAhead, 8);
    ASSERT_TRUE(travel.has_value()) << metres;
    EXPECT_NEAR(travel->length, metres, 3.0 * travel->sigma);
    EXPECT_LT(travel->sigma, 0.01 + 0.04 * metres);
    EXPECT_TRUE(travel->in_metres);
    EXPECT_EQ(travel->source, LengthSource::kStereo);
  }
}

TEST(StereoTravel, TellsAStandstill) {
  const auto travel = stereo_travel(seen_over(0.0, 100), kAhead, 8);
  ASSERT_TRUE(travel.has_value());
  EXPECT_LT(travel->length, 0.01);
  EXPECT_LT(travel->sigma, 0.01);
}

TEST(StereoTravel, WhatRestsWhereTheCarMayBeTellsNoStandstill) {
  TwoView seen = seen_over(0.0, 100);
  for (Correspondence& ac : seen.pair.correspondences) ac.depth->z *= 0.1;  // 0.4 to 2.5 m
  EXPECT_FALSE(stereo_travel(seen, kAhead, 8).has_value());
}

TEST(StereoTravel, DoesNotTakeTheMotionOfACarThatCrossesForItsOwn) {
  TwoView seen = seen_over(0.0, 60);
  TwoView car = seen_over(0.4, 40, 2);  // its points move by themselves
  seen.pair.correspondences.insert(seen.pair.correspondences.end(),
                                   car.pair.correspondences.begin(),
                                   car.pair.correspondences.end());
  seen.inliers.assign(seen.pair.size(), true);
  const auto travel = stereo_travel(seen, kAhead, 8);
  EXPECT_LT(travel ? travel->length : 0.0, 0.02);
}

TEST(StereoTravel, SaysNothingWithAHandfulOfDepthsOrADissentingMajority) {
  EXPECT_FALSE(stereo_travel(seen_over(0.3, 5), kAhead, 8).has_value());
  EXPECT_FALSE(stereo_travel(seen_over(0.3, 0), kAhead, 0).has_value());
  TwoView seen = seen_over(1.5, 30);
  for (std::size_t i = 0; i < 20; ++i) {
    seen.pair.correspondences[i].depth->z *= 2.0 + 0.5 * static_cast<double>(i);
  }
  EXPECT_FALSE(stereo_travel(seen, kAhead, 8).has_value());
}

}  // namespace
}  // namespace oneac
