#include "oneac/report/overlay.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace oneac {
namespace {

TEST(OverlaySvg, DrawsInliersApartAndLeavesOutWhatIsNotFinite) {
  Mark mark{{10.0, 20.0}, {12.0, 21.0}};
  mark.A << 2.0, 0.0, 0.0, 1.0;
  Overlay overlay{100, 50, "foo", {mark, mark, mark}};
  overlay.marks[1].u1 = {30.0, 40.0};
  overlay.marks[1].poor = 1.0;
  overlay.marks[2].u2.x() = std::numeric_limits<double>::quiet_NaN();
  const std::string svg = overlay_svg(overlay);
  // Eight pixels to each side, stretched twice to the right.
  EXPECT_NE(svg.find("class=\"inlier\" stroke=\"rgb(79,195,255)\" d=\"M10.0 20.0L12.0 21.0M-4.0 "
                     "13.0L28.0 13.0L28.0 29.0L-4.0 29.0Z\""),
            std::string::npos)
      << svg;
  EXPECT_NE(svg.find("class=\"outlier\" stroke=\"rgb(255,140,46)\" d=\"M30.0 40.0L"),
            std::string::npos)
      << svg;
  EXPECT_NE(svg.find("data:image/jpeg;base64,Zm9v"), std::string::npos) << svg;
  EXPECT_EQ(svg.find("nan"), std::string::npos) << svg;
}

TEST(ColourOf, StaysBetweenBlueAndOrange) {
  EXPECT_EQ(colour_of(-1.0), colour_of(0.0));
  EXPECT_EQ(colour_of(2.0), colour_of(1.0));
  EXPECT_GT(colour_of(0.0)[2], colour_of(0.0)[0]);  // blue
  EXPECT_LT(colour_of(1.0)[2], colour_of(1.0)[0]);  // orange
}

TEST(Pictures, AreOfTheirFormat) {
  const GreyImage image(64, 48, 90);
  EXPECT_EQ(jpeg_of(image.view()).substr(0, 2), "\xff\xd8");
  const std::string bare = overlay_png(image.view(), {});
  EXPECT_EQ(bare.substr(1, 3), "PNG");
  EXPECT_NE(overlay_png(image.view(), {{{10.0, 10.0}, {30.0, 20.0}}}), bare);
  EXPECT_EQ(tinted_png(image.view(), 1, 2, {{"0.1", 0.5}, {}}).substr(1, 3), "PNG");
}

TEST(Pictures, RefuseWhatTheyCannotDraw) {
  EXPECT_THROW((void)jpeg_of(ImageView()), std::invalid_argument);
  EXPECT_THROW((void)overlay_png(ImageView(), {}), std::invalid_argument);
  EXPECT_THROW((void)tinted_png(GreyImage(8, 8).view(), 2, 2, {{}}), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
