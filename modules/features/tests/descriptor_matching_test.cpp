#include "oneac/features/descriptor_matching.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace oneac {
namespace {

/// Frames on a grid 20 px apart with random unit descriptors.
AffineFeatures random_features(SceneGenerator& scene, int count) {
  AffineFeatures features;
  features.descriptors.resize(count, 128);
  for (int i = 0; i < count; ++i) {
    AffineFrame frame;
    const int row = i / 10, column = i % 10;
    frame.centre = {20.0 * column, 20.0 * row};
    frame.shape = 5.0 * Eigen::Matrix2d::Identity();
    features.frames.push_back(frame);
    for (int k = 0; k < 128; ++k) {
      features.descriptors(i, k) = static_cast<float>(scene.uniform(0.0, 1.0));
    }
    features.descriptors.row(i).normalize();
  }
  return features;
}

AffineFeatures moved(AffineFeatures features, const Eigen::Matrix2d& A,
                     const Eigen::Vector2d& shift) {
  for (AffineFrame& frame : features.frames) {
    frame.centre += shift;
    frame.shape = A * frame.shape;
  }
  return features;
}

TEST(MatchFeatures, ReturnsThePartnersWithTheirRelativeAffinity) {
  SceneGenerator scene(41);
  const AffineFeatures first = random_features(scene, 50);
  Eigen::Matrix2d A;
  A << 1.1, 0.1, -0.05, 0.95;
  const auto acs = match_features(first, moved(first, A, {7.0, 3.0}), {});
  ASSERT_EQ(acs.size(), 50U);
  for (std::size_t i = 0; i < acs.size(); ++i) {
    EXPECT_EQ(acs[i].x1, first.frames[i].centre);
    EXPECT_TRUE(acs[i].x2.isApprox(acs[i].x1 + Eigen::Vector2d(7.0, 3.0)));
    EXPECT_TRUE(acs[i].A.isApprox(A, 1e-12));
  }
}

TEST(MatchFeatures, DropsAmbiguousMatches) {
  SceneGenerator scene(42);
  const AffineFeatures first = random_features(scene, 20);
  AffineFeatures second = first;
  second.descriptors.row(1) = second.descriptors.row(0);  // a repeated pattern
  const auto acs = match_features(first, second, {});
  for (const auto& ac : acs) EXPECT_NE(ac.x1, first.frames[0].centre);
  EXPECT_EQ(acs.size(), 18U);  // 0 is ambiguous, 1 has lost its partner
}

TEST(MatchFeatures, ChecksBothDirections) {
  SceneGenerator scene(43);
  AffineFeatures first = random_features(scene, 20);
  const AffineFeatures second = first;
  // A copy of feature 0, less alike, competes for the same partner.
  first.frames.push_back(first.frames[0]);
  first.frames.back().centre = {300.0, 0.0};
  first.descriptors.conservativeResize(21, 128);
  first.descriptors.row(20) = first.descriptors.row(0);
  first.descriptors(20, 0) += 0.02F;
  first.descriptors.row(20).normalize();
  MatchOptions options;
  options.snn_ratio = 1.0;
  EXPECT_EQ(match_features(first, second, options).size(), 20U);
  options.mutual = false;
  options.max_shift_px = 1000.0;
  first.frames[20].centre = {300.0, 0.0};
  EXPECT_EQ(match_features(first, second, options).size(), 20U);  // one partner, one match
}

TEST(MatchFeatures, GatesImplausibleShiftsAndScales) {
  SceneGenerator scene(44);
  const AffineFeatures first = random_features(scene, 10);
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  EXPECT_TRUE(match_features(first, moved(first, I, {600.0, 0.0}), {}).empty());
  EXPECT_TRUE(match_features(first, moved(first, 3.0 * I, {0.0, 0.0}), {}).empty());
  Eigen::Matrix2d mirror = I;
  mirror(0, 0) = -1.0;
  EXPECT_TRUE(match_features(first, moved(first, mirror, {0.0, 0.0}), {}).empty());
}

TEST(MatchFeatures, KeepsOneMatchPerPoint) {
  SceneGenerator scene(45);
  AffineFeatures first = random_features(scene, 10);
  first.frames[1].centre = first.frames[0].centre + Eigen::Vector2d(0.2, 0.1);
  EXPECT_EQ(match_features(first, first, {}).size(), 9U);
}

TEST(MatchFeatures, IsEmptyWithoutFeatures) {
  SceneGenerator scene(46);
  const AffineFeatures some = random_features(scene, 5);
  EXPECT_TRUE(match_features({}, some, {}).empty());
  EXPECT_TRUE(match_features(some, {}, {}).empty());
}

TEST(FeatureOptions, NameFieldValueAndBound) {
  FeatureOptions options;
  options.match.snn_ratio = 1.5;
  try {
    options.validate();
    FAIL() << "must throw";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("match.snn_ratio = 1.5"), std::string::npos);
  }
}

}  // namespace
}  // namespace oneac
