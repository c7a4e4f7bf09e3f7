#include "two_view/plausible_depths.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace oneac {
namespace {

constexpr double kFocal = 600.0;
constexpr double kNoise = 0.1 / kFocal;
const RelativePose kAhead{Eigen::Matrix3d::Identity(), {0.0, 0.0, -1.0}};

/// A point at X [baselines] as a car sees it that goes on by one, whose patch faces the camera.
Correspondence seen_at(const Eigen::Vector3d& X) {
  const Eigen::Vector3d X2 = X + kAhead.t;
  Correspondence ac;
  ac.x1 = X.hnormalized();
  ac.x2 = X2.hnormalized();
  ac.A = X.z() / X2.z() * Eigen::Matrix2d::Identity();
  ac.point_sigma = kNoise;
  return ac;
}

/// A street of a hundred points.
TrackedPair street() {
  SceneGenerator random(6);
  TrackedPair pair;
  for (int i = 0; i < 100; ++i) {
    pair.correspondences.push_back(
        seen_at({random.uniform(-8.0, 8.0), random.uniform(-4.0, 1.5), random.uniform(6.0, 60.0)}));
  }
  return pair;
}

std::size_t kept(const TrackedPair& pair, const MotionPrior& motion = {}) {
  const std::vector<bool> inliers(pair.size(), true);
  const auto flags = with_plausible_depths(pair, inliers, kAhead, motion, kFocal);
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), true));
}

TEST(PlausibleDepths, AStreetHasThem) {
  EXPECT_EQ(kept(street()), 100U);
}

TEST(PlausibleDepths, AMatchAcrossThePictureHasNotGrownAsItHadTo) {
  TrackedPair pair = street();
  Correspondence wrong = seen_at({0.2, -0.1, 1.6});
  EXPECT_GT((wrong.x2 - wrong.x1).norm() * kFocal, 100.0);
  wrong.A.setIdentity();
  pair.correspondences.push_back(wrong);
  EXPECT_EQ(kept(pair), 100U);
  pair.correspondences.back() = seen_at({0.2, -0.1, 1.6});
  EXPECT_EQ(kept(pair), 101U) << "one that has";
}

TEST(PlausibleDepths, WhatGoesTowardsTheEpipoleIsBehindTheCamera) {
  TrackedPair pair = street();
  Correspondence wrong = seen_at({2.0, 1.0, 10.0});
  std::swap(wrong.x1, wrong.x2);
  pair.correspondences.push_back(wrong);
  EXPECT_EQ(kept(pair), 100U);
}

TEST(PlausibleDepths, NothingIsNearerThanTheRoad) {
  // Six baselines are a third of a camera height when one is a twentieth.
  MotionPrior slow;
  slow.length = 0.05;
  slow.length_sigma = 0.001;
  TrackedPair pair = street();
  pair.correspondences.push_back(seen_at({1.0, 0.5, 5.0}));
  EXPECT_EQ(kept(pair), 101U);
  for (Correspondence& ac : pair.correspondences) ac = seen_at({0.3, 0.2, 30.0});
  pair.correspondences.back() = seen_at({1.0, 0.5, 5.0});
  EXPECT_EQ(kept(pair, slow), pair.size() - 1);
}

TEST(PlausibleDepths, AllAreKeptWhereItIsThePoseThatIsWrong) {
  const TrackedPair pair = street();
  const std::vector<bool> inliers(pair.size(), true);
  const RelativePose backwards{kAhead.R, -kAhead.t};
  EXPECT_EQ(with_plausible_depths(pair, inliers, backwards, {}, kFocal), inliers);
}

}  // namespace
}  // namespace oneac
