#include "feature_mask.h"

#include "texture.h"

#include "oneac/base/error.h"
#include "oneac/features/ac_tracker.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <stdexcept>

namespace oneac::internal {
namespace {

/// A binary PGM: dark below row `dark_from`.
void write_mask(const std::filesystem::path& path, int width, int height, int dark_from) {
  std::ofstream out(path, std::ios::binary);
  out << "P5\n" << width << " " << height << "\n255\n";
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) out.put(static_cast<char>(v < dark_from ? 255 : 0));
  }
}

TEST(FeatureMask, LeavesOutSeveralPolygons) {
  const FeatureMask mask({"10,10 20,10 20,20 10,20; 100,0 120.5,0 110,30", ""});
  EXPECT_FALSE(mask.usable({15, 15}));
  EXPECT_FALSE(mask.usable({110, 10}));
  EXPECT_TRUE(mask.usable({25, 15}));
  EXPECT_TRUE(mask.usable({110, 40}));
}

TEST(FeatureMask, UsesEverythingWithoutOptions) {
  EXPECT_TRUE(FeatureMask(MaskOptions{}).usable({0, 0}));
}

TEST(FeatureMask, RefusesWhatIsNoPolygon) {
  for (const char* text : {"1,2 3,4", "1,2 3,4 5", "1,2 3,4 5;6", "a,b c,d e,f", "1,2 3,4 5,6x"}) {
    EXPECT_THROW(MaskOptions({text, ""}).validate(), std::invalid_argument) << text;
  }
}

TEST(FeatureMask, ReadsAPicture) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "mask.pgm";
  write_mask(path, 40, 30, 20);
  const FeatureMask mask({"", path.string()});
  EXPECT_TRUE(mask.usable({39, 19}));
  EXPECT_FALSE(mask.usable({39, 20}));
  EXPECT_FALSE(mask.usable({40, 0}));
  EXPECT_NO_THROW(mask.require_size(40, 30));
  EXPECT_THROW(mask.require_size(41, 30), InputError);
  EXPECT_THROW(FeatureMask({"", (folder.path() / "none.png").string()}), InputError);
}

TEST(FeatureMask, KeepsCornersAndTracksAway) {
  for (const char* extractor : {"klt", "vlfeat"}) {
    FeatureOptions options;
    options.extractor = extractor;
    options.mask.polygon = "0,200 480,200 480,360 0,360";
    const auto tracker = make_tracker(options);
    View moved;
    moved.shift = {0.0, 6.0};
    static_cast<void>(tracker->advance(tracker->prepare(render(Texture(31), View{}).view()), {}));
    const auto pair = tracker->advance(tracker->prepare(render(Texture(31), moved).view()), {});
    EXPECT_GT(pair.size(), 50U) << extractor;
    for (const auto& ac : pair.correspondences) {
      EXPECT_LT(ac.x1.y(), 200.5);
      EXPECT_LT(ac.x2.y(), 200.5);
    }
  }
}

/// Dark below a row.
GreyImage dark_from(int row) {
  GreyImage mask(480, 360, 255);
  for (int v = row; v < mask.height(); ++v) std::fill_n(mask.row(v), mask.width(), std::uint8_t{0});
  return mask;
}

TEST(MaskOfAnImage, KeepsCornersAndTracksAwayInThatImageAlone) {
  for (const char* extractor : {"klt", "vlfeat", "sift"}) {
    FeatureOptions options;
    options.extractor = extractor;
    const auto tracker = make_tracker(options);
    View moved;
    moved.shift = {0.0, 6.0};
    const GreyImage first = render(Texture(31), View{}), second = render(Texture(31), moved);
    const GreyImage low = dark_from(300), high = dark_from(200);
    static_cast<void>(tracker->advance(tracker->prepare(first.view(), low.view()), {}));
    EXPECT_EQ(tracker->unused().data[299 * 480], 255);
    EXPECT_EQ(tracker->unused().data[300 * 480], 0);
    const auto pair = tracker->advance(tracker->prepare(second.view(), high.view()), {});
    EXPECT_EQ(tracker->unused().data[200 * 480], 0) << "of the road neither";
    EXPECT_GT(pair.size(), 50U) << extractor;
    for (const auto& ac : pair.correspondences) {
      EXPECT_LT(ac.x1.y(), 300.5) << extractor;
      EXPECT_LT(ac.x2.y(), 200.5) << extractor;
    }
    const auto third = tracker->advance(tracker->prepare(first.view()), {});
    for (const auto& ac : third.correspondences) EXPECT_LT(ac.x1.y(), 200.5) << extractor;
    EXPECT_EQ(tracker->unused().data[200 * 480], 0) << "the image before had one";
    static_cast<void>(tracker->advance(tracker->prepare(second.view()), {}));
    EXPECT_TRUE(tracker->unused().empty()) << "none has any more";
  }
}

TEST(MaskOfAnImage, KeepsTracksAwayWhileTheCameraStands) {
  const auto tracker = make_tracker({});
  const GreyImage image = render(Texture(31), View{}), mask = dark_from(100);
  static_cast<void>(tracker->advance(tracker->prepare(image.view()), {}));
  const auto pair = tracker->advance(tracker->prepare(image.view(), mask.view()), {});
  ASSERT_TRUE(pair.standing);
  EXPECT_GT(pair.size(), 20U);
  for (const auto& ac : pair.correspondences) EXPECT_LT(ac.x2.y(), 100.5);
}

TEST(MaskOfAnImage, HasItsSize) {
  const auto tracker = make_tracker({});
  const GreyImage image = render(Texture(31), View{});
  EXPECT_THROW(static_cast<void>(tracker->prepare(image.view(), GreyImage(48, 36, 255).view())),
               std::invalid_argument);
}

}  // namespace
}  // namespace oneac::internal
