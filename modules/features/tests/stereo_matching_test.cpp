#include "oneac/features/stereo_matching.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace oneac {
namespace {

constexpr int kWidth = 320, kHeight = 120;

struct Wave {
  double along_u, along_v, phase;  ///< [rad/px], [rad]
};

/// Forty plane waves of 6 to 30 px in made-up directions: smooth, and nothing in them repeats.
std::vector<Wave> waves() {
  std::uint32_t state = 12345;
  const auto uniform = [&state] {
    state = state * 1664525U + 1013904223U;
    return static_cast<double>(state >> 8) / 16777216.0;
  };
  std::vector<Wave> waves(40);
  for (Wave& wave : waves) {
    const double angle = 6.2832 * uniform(), length = 6.0 + 24.0 * uniform();
    wave = {6.2832 * std::cos(angle) / length, 6.2832 * std::sin(angle) / length,
            6.2832 * uniform()};
  }
  return waves;
}

double texture(double u, double v) {
  static const std::vector<Wave> kWaves = waves();
  double grey = 128.0;
  for (const Wave& w : kWaves) grey += 7.0 * std::sin(w.along_u * u + w.along_v * v + w.phase);
  return grey;
}

/// The texture seen `disparity` px farther left, lighter and with less contrast by choice.
GreyImage image(double disparity, double row_offset = 0.0, double gain = 1.0, double bias = 0.0) {
  GreyImage out(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const double grey = gain * texture(u + disparity, v - row_offset) + bias;
      out.row(v)[u] = static_cast<std::uint8_t>(std::lround(std::min(std::max(grey, 0.0), 255.0)));
    }
  }
  return out;
}

std::vector<Eigen::Vector2d> points() {
  std::vector<Eigen::Vector2d> points;
  for (int v = 20; v < kHeight - 20; v += 20) {
    for (int u = 90; u < kWidth - 30; u += 25) points.emplace_back(u + 0.3, v - 0.4);
  }
  return points;
}

TEST(StereoMatching, FindsDisparitiesToATenthOfAPixel) {
  const GreyImage left = image(0.0), right = image(23.4, 0.0, 0.8, 15.0);
  std::size_t found = 0;
  for (const auto& disparity : match_along_rows(left.view(), right.view(), points())) {
    if (!disparity) continue;
    ++found;
    EXPECT_NEAR(disparity->px, 23.4, 0.1);
    EXPECT_GE(disparity->sigma_px, 0.05);
    EXPECT_LT(disparity->sigma_px, 0.3);
  }
  EXPECT_GE(found, points().size() * 8 / 10);
}

TEST(StereoMatching, PassesOverHalfAPixelOfBadRectificationButNotMore) {
  const GreyImage left = image(0.0);
  const GreyImage near_by = image(12.0, 0.5), far_off = image(12.0, 3.0);
  std::size_t found = 0;
  for (const auto& disparity : match_along_rows(left.view(), near_by.view(), points())) {
    if (!disparity) continue;
    ++found;
    EXPECT_NEAR(disparity->px, 12.0, 0.15);
  }
  EXPECT_GE(found, points().size() / 2);
  std::size_t wrong = 0;  // another place that happens to look alike
  for (const auto& disparity : match_along_rows(left.view(), far_off.view(), points())) {
    if (disparity) ++wrong;
  }
  EXPECT_LE(wrong, points().size() / 10);
}

TEST(StereoMatching, DoesNotChooseAmongRepeatedThings) {
  GreyImage fence(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) fence.row(v)[u] = u % 12 < 6 ? 50 : 200;
  }
  for (const auto& disparity : match_along_rows(fence.view(), fence.view(), points())) {
    EXPECT_FALSE(disparity.has_value());
  }
}

TEST(StereoMatching, SaysNothingWhereThereIsNothingToSee) {
  const GreyImage blank(kWidth, kHeight, 90), left = image(0.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& d : match_along_rows(blank.view(), blank.view(), points())) EXPECT_FALSE(d);
  for (const auto& d : match_along_rows(left.view(), blank.view(), points())) EXPECT_FALSE(d);
  const std::vector<Eigen::Vector2d> outside = {{-5.0, 20.0}, {nan, 30.0}, {1e300, 10.0}, {2, 2}};
  for (const auto& d : match_along_rows(left.view(), left.view(), outside)) EXPECT_FALSE(d);
}

TEST(StereoMatching, RefusesImagesOfDifferentSizeAndOptionsOutOfBounds) {
  const GreyImage left = image(0.0), small(50, 50);
  EXPECT_THROW(static_cast<void>(match_along_rows(left.view(), small.view(), points())),
               std::invalid_argument);
  StereoMatchOptions options;
  options.radius_px = 0;
  EXPECT_THROW(options.validate(), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
