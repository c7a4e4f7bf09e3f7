#include "oneac/calibration/camera_change.h"

#include "oneac/calibration/intrinsics.h"
#include "oneac/test_support/synthetic_bend.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

PinholeCamera learned_camera() {
  IntrinsicsVector change;
  change << 0.04, 0.01, -0.02, -0.08, 0.03;
  return changed(true_camera(), change);
}

TEST(CameraChange, KeepsThePixel) {
  const PinholeCamera from = true_camera(), to = learned_camera();
  const CameraChange change(from, to), back(to, from);
  for (const Eigen::Vector2d& x : {Eigen::Vector2d(0.5, 0.2), Eigen::Vector2d(-0.7, -0.1)}) {
    EXPECT_LT((project_distorted(to, change(x)) - from.project(x)).norm(), 1e-6);
    EXPECT_LT((back(change(x)) - x).norm(), 1e-9);
    EXPECT_LT(
        (back.derivative(change(x)) * change.derivative(x) - Eigen::Matrix2d::Identity()).norm(),
        1e-5);
  }
  EXPECT_NEAR(change.factor(), 1.0 / std::exp(0.04), 1e-12);
}

TEST(CameraChange, OfTheFocalLengthAloneIsAFactor) {
  PinholeCamera longer = true_camera();
  longer.fx *= 1.05;
  longer.fy *= 1.05;
  const CameraChange change(true_camera(), longer);
  EXPECT_LT((change({0.4, -0.3}) - change.factor() * Eigen::Vector2d(0.4, -0.3)).norm(), 1e-12);
}

TEST(CameraChange, IsFiniteWhereALensFoldsOver) {
  PinholeCamera folds = true_camera();
  folds.distortion[0] = -0.9;
  EXPECT_TRUE(CameraChange(true_camera(), folds)({2.0, 1.0}).allFinite());
}

TEST(CameraChange, OfALongerFocalLengthIsAFactorWhateverTheLensDoes) {
  PinholeCamera raw = true_camera();
  raw.distortion = {-0.3, 0.12, 1e-3, -5e-4, -0.02};
  const CameraChange change(raw, with_longer_focal(raw, 1.05));
  EXPECT_LT((change({0.6, -0.2}) - Eigen::Vector2d(0.6, -0.2) / 1.05).norm(), 1e-8);
}

TEST(PinholeOf, HasTheCentreAndTheFocalLengthOfTheDirections) {
  PinholeCamera raw = true_camera(), given = true_camera();
  raw.distortion = {-0.3, 0.12, 1e-3, -5e-4, -0.02};
  given.fx = given.fy = 500.0;
  IntrinsicsVector change;
  change << 0.04, 0.01, -0.02, -0.08, 0.03;
  const PinholeCamera used = changed(raw, change), pinhole = pinhole_of(given, raw, used);
  const CameraChange to_used(raw, used);
  EXPECT_LT(to_used(given.normalise({pinhole.cx, pinhole.cy})).norm(), 1e-8);
  EXPECT_NEAR(pinhole.fx, 500.0 * std::exp(0.04), 1e-9);
  const PinholeCamera same = pinhole_of(given, raw, raw);
  EXPECT_NEAR(same.cx, given.cx, 1e-9);
  EXPECT_EQ(same.fx, given.fx);
}

}  // namespace
}  // namespace oneac
