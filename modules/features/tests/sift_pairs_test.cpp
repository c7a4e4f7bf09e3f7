#include "oneac/features/sift_pairs.h"

#include "texture.h"

#include "oneac/base/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace oneac {
namespace {

/// The same picture in another light, turned, moved.
View other_view() {
  View view;
  view.A << 1.05, 0.06, -0.04, 0.98;
  view.shift = {12.0, -7.0};
  view.gain = 0.7;
  view.noise = 1.5;
  return view;
}

TEST(SiftPairs, AlignsWhatItMatchedInAnotherLight) {
  const Texture texture(3);
  const View first, second = other_view();
  const GreyImage a = render(texture, first), b = render(texture, second);
  const SiftPairs pairs({});
  const AffineFeatures fa = pairs.detect(a.view()), fb = pairs.detect(b.view());
  const auto found = pairs.match(fa, fb, a.view(), b.view());
  ASSERT_GT(found.size(), 50U);
  std::vector<double> errors, affine_errors;
  for (const Correspondence& pair : found) {
    errors.push_back((pair.x2 - second.map(pair.x1)).norm());
    affine_errors.push_back((pair.A - second.A).norm());
    const Eigen::Vector2d feature = pair.x2 - pair.moved;
    EXPECT_TRUE(std::any_of(fb.frames.begin(), fb.frames.end(), [&](const AffineFrame& frame) {
      return (frame.centre - feature).norm() < 1e-9;
    }));
  }
  EXPECT_LT(median_of(errors), 0.1);
  EXPECT_LT(median_of(affine_errors), 0.05);
}

TEST(SiftPairs, LooksAtNothingThatIsTheCars) {
  const Texture texture(3);
  const GreyImage image = render(texture, View{});
  GreyImage car(image.width(), image.height(), 255);
  for (int v = 200; v < car.height(); ++v) std::fill_n(car.row(v), car.width(), std::uint8_t{0});
  FeatureOptions options;
  options.mask.polygon = "0,0 100,0 100,360 0,360";
  const AffineFeatures features = SiftPairs(options, std::move(car)).detect(image.view());
  ASSERT_GT(features.frames.size(), 20U);
  EXPECT_EQ(features.descriptors.rows(), static_cast<Eigen::Index>(features.frames.size()));
  for (const AffineFrame& frame : features.frames) {
    EXPECT_LT(frame.centre.y(), 200.5);
    EXPECT_GT(frame.centre.x(), 99.5);
  }
}

TEST(SiftPairs, FindsNothingInTheDark) {
  const GreyImage dark(320, 240);
  const SiftPairs pairs({});
  const AffineFeatures none = pairs.detect(dark.view());
  EXPECT_TRUE(none.frames.empty());
  EXPECT_TRUE(pairs.match(none, none, dark.view(), dark.view()).empty());
}

}  // namespace
}  // namespace oneac
