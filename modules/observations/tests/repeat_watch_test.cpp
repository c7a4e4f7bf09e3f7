#include "oneac/observations/repeat_watch.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

GreyImage textured(int width, int height) {
  GreyImage image(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) image.row(v)[u] = static_cast<std::uint8_t>(7 * u + 13 * v);
  }
  return image;
}

TEST(RepeatWatch, NoticesTheSamePixelsOnceMore) {
  RepeatWatch watch;
  EXPECT_FALSE(watch.repeats(textured(37, 20).view()));
  EXPECT_TRUE(watch.repeats(textured(37, 20).view()));
  EXPECT_TRUE(watch.repeats(textured(37, 20).view()));
}

TEST(RepeatWatch, LetsAnImagePassThatDiffersByOneGreyLevelOfItsLastPixel) {
  RepeatWatch watch;
  GreyImage image = textured(37, 20);
  EXPECT_FALSE(watch.repeats(image.view()));
  ++image.row(19)[36];
  EXPECT_FALSE(watch.repeats(image.view()));
  EXPECT_TRUE(watch.repeats(image.view()));
}

TEST(RepeatWatch, LetsAnImagePassThatWasSeenBeforeTheLast) {
  RepeatWatch watch;
  EXPECT_FALSE(watch.repeats(textured(37, 20).view()));
  EXPECT_FALSE(watch.repeats(GreyImage(37, 20).view()));
  EXPECT_FALSE(watch.repeats(textured(37, 20).view()));
}

TEST(RepeatWatch, TellsSizesApart) {
  RepeatWatch watch;
  EXPECT_FALSE(watch.repeats(GreyImage(40, 20).view()));
  EXPECT_FALSE(watch.repeats(GreyImage(20, 40).view()));
}

}  // namespace
}  // namespace oneac
