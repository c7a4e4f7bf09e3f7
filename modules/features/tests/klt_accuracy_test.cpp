#include "texture.h"

#include "oneac/features/ac_tracker.h"
#include "oneac/features/feature_options.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace oneac {
namespace {

FeatureOptions klt() {
  FeatureOptions options;
  options.extractor = "klt";
  return options;
}

/// A view of the strength given: 1 is 20 % scale, 10° of rotation and of shear, 60 px, 20 % gain.
View random_view(SceneGenerator& scene, double strength) {
  const double limit = 10.0 * 3.14159265358979 / 180.0 * strength;
  const double scale = 1.0 + scene.uniform(-0.2, 0.2) * strength;
  const double angle = scene.uniform(-limit, limit);
  Eigen::Matrix2d rotation, shear;
  rotation << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  shear << 1.0, std::tan(scene.uniform(-limit, limit)), 0.0, 1.0;
  View view;
  view.A = scale * rotation * shear;
  view.shift = {scene.uniform(-42, 42), scene.uniform(-42, 42)};  // at most 60 px long
  view.gain = 1.0 + scene.uniform(-0.2, 0.2);
  view.noise = 3.0;
  return view;
}

struct Errors {
  std::vector<double> affine, point, affine_in_sigmas, point_in_sigmas;
};

/// What the tracker finds between two views of a texture.
TrackedPair tracked(const Texture& texture, const View& first, const View& second) {
  const GreyImage one = render(texture, first), two = render(texture, second);
  const auto tracker = make_tracker(klt());
  static_cast<void>(tracker->advance(tracker->prepare(one.view()), {}));
  return tracker->advance(tracker->prepare(two.view()), {});
}

/// What is found between two views, and the warp between them.
void add_errors(const TrackedPair& pair, const View& second, Errors& errors) {
  for (const Correspondence& ac : pair.correspondences) {
    const double affine = (ac.A - second.A).norm(), point = (ac.x2 - second.map(ac.x1)).norm();
    errors.affine.push_back(affine);
    errors.point.push_back(point);
    errors.affine_in_sigmas.push_back(affine / 2.0 / ac.affine_sigma);
    errors.point_in_sigmas.push_back(point / std::sqrt(2.0) / ac.point_sigma);
  }
}

/// Tracks one pair per seed and compares with the warp that made it.
Errors errors_over(std::uint64_t seed, int pairs, double strength) {
  SceneGenerator scene(seed);
  Errors errors;
  for (int i = 0; i < pairs; ++i) {
    const Texture texture(seed + static_cast<std::uint64_t>(i));
    View first, second = random_view(scene, strength);
    first.noise = second.noise;
    second.seed = seed + 1000 + static_cast<std::uint64_t>(i);
    add_errors(tracked(texture, first, second), second, errors);
  }
  return errors;
}

double share_above(const std::vector<double>& values, double bound) {
  std::size_t above = 0;
  for (const double value : values) above += value > bound ? 1 : 0;
  return static_cast<double>(above) / static_cast<double>(values.size());
}

TEST(KltAccuracy, AffinityOfWarpsUpToTenPercentIsWithinAFewThousandths) {
  const Errors errors = errors_over(201, 8, 0.5);
  ASSERT_GT(errors.affine.size(), 8U * 150U);
  EXPECT_LT(median_of(errors.affine), 0.015);
  EXPECT_LT(median_of(errors.point), 0.1);
  EXPECT_LT(share_above(errors.affine, 0.1), 0.01);
}

TEST(KltAccuracy, WhatIsReturnedUnderStrongWarpsIsRight) {
  const Errors errors = errors_over(301, 12, 1.0);
  ASSERT_GT(errors.affine.size(), 12U * 60U);
  EXPECT_LT(share_above(errors.affine, 0.1), 0.01);
  EXPECT_LT(share_above(errors.point, 1.0), 0.01);
}

/// A road comes nearer: far from affine over a patch, so that centres are found too low.
TEST(KltAccuracy, TellsHowFarPerspectiveShiftsAPatch) {
  std::vector<double> found, corrected;
  for (std::uint64_t seed = 601; seed < 607; ++seed) {
    View first, second;
    second.bend = {0.0, -0.001};  // half a camera height of way, a focal length of 500 px
    second.seed = seed;
    first.noise = second.noise = 1.0;
    const Texture texture(seed);
    const TrackedPair pair = tracked(texture, first, second);
    for (const Correspondence& ac : pair.correspondences) {
      const Eigen::Vector2d d = ac.x1 - first.centre();
      const Eigen::Vector2d eta = second.bend / (1.0 + second.bend.dot(d));
      const Eigen::Vector2d shift = ac.A * (ac.perspective * eta);
      const double error = (ac.x2 - second.map(ac.x1)).y();
      found.push_back(error);
      corrected.push_back(error + shift.y());
    }
  }
  ASSERT_GT(found.size(), 600U);
  EXPECT_GT(median_of(found), 0.015);  // [px]
  EXPECT_LT(std::abs(median_of(corrected)), 0.25 * median_of(found));
}

TEST(KltAccuracy, SigmasTellTheSizeOfTheErrors) {
  const Errors errors = errors_over(401, 4, 0.3);
  ASSERT_GT(errors.affine.size(), 400U);
  // The root mean square of four (two) normal variables has a median near 0.92 (0.83).
  EXPECT_GT(median_of(errors.affine_in_sigmas), 0.4);
  EXPECT_LT(median_of(errors.affine_in_sigmas), 1.4);
  EXPECT_GT(median_of(errors.point_in_sigmas), 0.35);
  EXPECT_LT(median_of(errors.point_in_sigmas), 1.4);
}

/// At night noise has as much gradient as the picture, and a slope under it looks like a corner.
TEST(KltAccuracy, SigmasHoldWhereNoiseHasTheGradient) {
  SceneGenerator scene(701);
  Errors errors;
  for (std::uint64_t seed = 701; seed < 709; ++seed) {
    View first, second;
    first.gain = second.gain = 0.3;
    first.noise = second.noise = 9.0;
    second.shift = {scene.uniform(-4, 4), scene.uniform(-4, 4)};
    second.seed = seed;
    add_errors(tracked(Texture(seed), first, second), second, errors);
  }
  ASSERT_GT(errors.point.size(), 2000U);
  EXPECT_GT(median_of(errors.point_in_sigmas), 0.3);
  EXPECT_LT(share_above(errors.point_in_sigmas, 3.0), 0.01) << "a fifth with the gradient as it is";
}

}  // namespace
}  // namespace oneac
