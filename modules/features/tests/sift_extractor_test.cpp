#include "oneac/features/sift_extractor.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

/// Soft blobs whose place does not depend on the size of the image.
GreyImage blobs(int scale) {
  constexpr int kWidth = 160, kHeight = 120;
  GreyImage image(kWidth * scale, kHeight * scale);
  SceneGenerator scene(5);
  struct Blob {
    double x, y, sigma, grey;
  };
  std::vector<Blob> all;
  for (int i = 0; i < 60; ++i) {
    all.push_back({scene.uniform(0, kWidth), scene.uniform(0, kHeight), scene.uniform(2, 5),
                   scene.uniform(-90, 90)});
  }
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const double x = (u + 0.5) / scale - 0.5, y = (v + 0.5) / scale - 0.5;
      double value = 128.0;
      for (const Blob& b : all) {
        const double r2 = ((x - b.x) * (x - b.x) + (y - b.y) * (y - b.y)) / (b.sigma * b.sigma);
        if (r2 < 20.0) value += b.grey * std::exp(-0.5 * r2);
      }
      image.row(v)[u] = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
    }
  }
  return image;
}

TEST(DetectSift, FindsInALargeImageWhatTheShrunkOneShows) {
  VlfeatOptions options;
  options.sift_megapixels = 0.1;
  const AffineFeatures small = detect_sift(blobs(1).view(), options);
  const AffineFeatures large = detect_sift(blobs(6).view(), options);  // 0.7 Mpx, shrunk to 0.1
  ASSERT_GT(small.frames.size(), 20U);
  std::size_t found = 0;
  for (const AffineFrame& frame : small.frames) {
    const Eigen::Vector2d expected = (frame.centre.array() + 0.5) * 6.0 - 0.5;
    found += std::any_of(large.frames.begin(), large.frames.end(), [&](const AffineFrame& other) {
      return (other.centre - expected).norm() < 4.0 &&
             std::abs(std::log(other.shape.norm() / (6.0 * frame.shape.norm()))) < 0.2;
    });
  }
  EXPECT_GT(2 * found, small.frames.size()) << found << " of " << small.frames.size();
}

}  // namespace
}  // namespace oneac
