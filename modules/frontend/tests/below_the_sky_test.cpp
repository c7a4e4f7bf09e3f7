#include "two_view/below_the_sky.h"

#include "two_view/two_view.h"

#include "oneac/frontend/front_end_options.h"
#include "oneac/geometry/angles.h"
#include "oneac/geometry/angular_errors.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace oneac {
namespace {

constexpr double kFocal = 600.0;

Correspondence seen_at(double x, double y, double moved_x, SceneGenerator& random) {
  constexpr double kNoise = 0.03 / kFocal;
  Correspondence ac;
  ac.x1 = {x, y};
  ac.x2 = {x + moved_x + random.uniform(-kNoise, kNoise), y + random.uniform(-kNoise, kNoise)};
  return ac;
}

/// Clouds that drift by more than an inlier bound a frame over a street at rest.
TrackedPair clouds_over_a_street(int below) {
  SceneGenerator random(4);
  TrackedPair pair;
  for (int i = 0; i < 500; ++i) {
    pair.correspondences.push_back(
        seen_at(random.uniform(-0.6, 0.6), random.uniform(-0.5, -0.1), 2.5 / kFocal, random));
  }
  for (int i = 0; i < below; ++i) {
    pair.correspondences.push_back(
        seen_at(random.uniform(-0.6, 0.6), random.uniform(-0.02, 0.4), 0.0, random));
  }
  for (std::size_t i = 0; i < pair.size(); ++i) pair.correspondences[i].track = i;
  return pair;
}

TEST(BelowTheSky, LeavesWhatIsNotAboveTheHorizonOfALevelCamera) {
  const TrackedPair pair = clouds_over_a_street(120);
  const auto below = below_the_sky(pair, Eigen::Matrix3d::Identity());
  EXPECT_EQ(std::count(below.begin(), below.end(), true), 120);
  // A camera that looks down by 45° sees no sky here.
  const auto all = below_the_sky(pair, pitch_rotation(45.0 * kDegree));
  const auto none = below_the_sky(pair, pitch_rotation(-45.0 * kDegree));
  EXPECT_EQ(std::max(std::count(all.begin(), all.end(), true),
                     std::count(none.begin(), none.end(), true)),
            620);
}

TEST(BelowTheSky, LeavesNothingWhereTooLittleIsThere) {
  EXPECT_TRUE(below_the_sky(clouds_over_a_street(30), Eigen::Matrix3d::Identity()).empty());
}

TEST(BelowTheSky, ACarThatStandsBelowDriftingCloudsDoesNotTurn) {
  const FrontEndOptions options;
  const TwoViewEstimator estimator(options, make_initialiser(options.initialiser));
  TwoViewPrior prior;
  prior.focal_px = kFocal;
  prior.expected = {Eigen::Matrix3d::Identity(), {0.0, 0.0, -1.0}};
  prior.motion.length_sigma = 0.02;  // it was expected to stand
  const TwoView seen = estimator.estimate(clouds_over_a_street(150), prior);
  EXPECT_EQ(seen.status, StepStatus::kNoMotion);
  EXPECT_LT(rotation_error(seen.pose.R, Eigen::Matrix3d::Identity()), 1e-4);
  EXPECT_EQ(std::count(seen.inliers.begin(), seen.inliers.begin() + 500, true), 0);
}

}  // namespace
}  // namespace oneac
