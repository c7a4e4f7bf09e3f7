#include "oneac/calibration/intrinsics.h"

#include "oneac/test_support/synthetic_bend.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

PinholeCamera distorted_camera() {
  PinholeCamera camera = true_camera();
  camera.distortion = {-0.3, 0.12, 1e-3, -5e-4, -0.02};
  return camera;
}

TEST(Intrinsics, AChangeLeadsFromOneCameraToTheOther) {
  IntrinsicsVector change;
  change << 0.05, 0.01, -0.02, 0.1, -0.03;
  const PinholeCamera from = distorted_camera(), to = changed(from, change);
  EXPECT_NEAR(to.fx, from.fx * std::exp(0.05), 1e-9);
  EXPECT_NEAR(to.fy / to.fx, from.fy / from.fx, 1e-12);
  EXPECT_NEAR(to.cx, from.cx + 7.2, 1e-9);
  EXPECT_LT((change_between(from, to) - change).norm(), 1e-12);
}

TEST(Intrinsics, NormalisingUndoesTheProjectionWithDistortion) {
  const PinholeCamera camera = distorted_camera();
  for (double x = -0.8; x < 0.81; x += 0.2) {
    for (double y = -0.25; y < 0.26; y += 0.1) {
      const Eigen::Vector2d there = project_distorted(camera, {x, y});
      EXPECT_LT((normalise_distorted(camera, there) - Eigen::Vector2d(x, y)).norm(), 1e-8);
    }
  }
}

TEST(Intrinsics, APixelThatNoRayReachesIsNotFinite) {
  PinholeCamera camera = true_camera();
  camera.distortion[0] = -0.5;  // folds over at a radius of 0.82, 0.54 in the image
  EXPECT_FALSE(normalise_distorted(camera, {camera.cx + 0.7 * camera.fx, camera.cy}).allFinite());
}

}  // namespace
}  // namespace oneac
