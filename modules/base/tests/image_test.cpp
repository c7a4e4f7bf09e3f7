#include "oneac/base/image.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace oneac {
namespace {

TEST(GreyImage, CopiesAViewWithoutItsPadding) {
  const std::uint8_t padded[] = {1, 2, 99, 3, 4, 99};
  const GreyImage image(ImageView{padded, 2, 2, 3});
  EXPECT_EQ(image.view().stride, 2);
  EXPECT_EQ(image.row(0)[1], 2);
  EXPECT_EQ(image.row(1)[0], 3);
  EXPECT_EQ(image.row(1)[1], 4);
}

TEST(GreyImage, RefusesANegativeSide) {
  EXPECT_THROW(GreyImage(-1, 2), std::invalid_argument);
}

TEST(ImageView, IsEmptyWithoutPixels) {
  EXPECT_TRUE(ImageView{}.empty());
  EXPECT_TRUE(GreyImage(0, 5).view().empty());
  EXPECT_FALSE(GreyImage(1, 1).view().empty());
}

}  // namespace
}  // namespace oneac
