#include "scale/stereo_depths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>

namespace oneac {
namespace {

constexpr int kWidth = 200, kHeight = 100, kDisparity = 12;

/// A wall of noise, 12 px of disparity away from a pair of cameras.
CameraFrame wall() {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> level(20, 230);
  CameraFrame frame;
  frame.image = GreyImage(kWidth, kHeight);
  frame.right = GreyImage(kWidth, kHeight, 100);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const auto grey = static_cast<std::uint8_t>(level(random));
      frame.image.row(v)[u] = grey;
      if (u >= kDisparity) frame.right.row(v)[u - kDisparity] = grey;
    }
  }
  frame.camera = {kWidth, kHeight, 150.0, 150.0, 99.5, 49.5};
  frame.baseline_m = 0.5;
  return frame;
}

TrackedPair points_all_over() {
  TrackedPair pair;
  for (int v = 20; v < kHeight - 20; v += 10) {
    for (int u = 50; u < kWidth - 20; u += 10) {
      Correspondence point;
      point.x2 = Eigen::Vector2d(u, v);
      pair.correspondences.push_back(point);
    }
  }
  return pair;
}

TEST(StereoDepths, AreThoseOfTheDisparity) {
  const TrackedPair pair = with_stereo_depths(points_all_over(), wall());
  std::size_t measured = 0;
  for (const Correspondence& point : pair.correspondences) {
    if (!point.depth) continue;
    ++measured;
    EXPECT_NEAR(point.depth->z, 150.0 * 0.5 / kDisparity, 0.1);
  }
  EXPECT_GT(measured, pair.correspondences.size() / 2);
}

TEST(StereoDepths, AreNoneWhereTheMaskOfTheRightImageIsDark) {
  CameraFrame frame = wall();
  frame.right_mask = GreyImage(kWidth, kHeight, 255);
  constexpr int kHidden = 80;
  for (int v = 0; v < kHeight; ++v) std::fill_n(frame.right_mask.row(v), kHidden, std::uint8_t{0});
  const TrackedPair pair = with_stereo_depths(points_all_over(), frame);
  std::size_t measured = 0;
  for (const Correspondence& point : pair.correspondences) {
    if (!point.depth) continue;
    ++measured;
    EXPECT_GE(point.x2.x() - kDisparity, kHidden - 1);
  }
  EXPECT_GT(measured, 10U);
}

}  // namespace
}  // namespace oneac
