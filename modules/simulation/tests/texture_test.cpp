#include "texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace oneac::simulation {
namespace {

Canvas checkerboard(int side) {
  Canvas canvas(side, side, 0.0F);
  for (int v = 0; v < side; ++v) {
    for (int u = 0; u < side; ++u) {
      if ((u + v) % 2 == 0) canvas.rectangle({u, v}, {u + 1, v + 1}, 200.0);
    }
  }
  return canvas;
}

TEST(Texture, ReturnsItsTexelsWhenLookedAtClosely) {
  const Texture texture(checkerboard(8), 0.5);
  const Footprint on_bright{{0.25F, 0.25F}, {0.001F, 0.0F}, {0.0F, 0.001F}};
  const Footprint on_dark{{0.75F, 0.25F}, {0.001F, 0.0F}, {0.0F, 0.001F}};
  EXPECT_NEAR(texture.sample(on_bright), 200.0F, 0.5F);
  EXPECT_NEAR(texture.sample(on_dark), 0.0F, 0.5F);
}

TEST(Texture, AveragesWhatAPixelCannotResolve) {
  const Texture texture(checkerboard(64), 0.1);
  float u = 0.0F;
  while (u < 3.0F) {
    const Footprint from_afar{{u, 1.1F * u}, {0.8F, 0.0F}, {0.0F, 0.8F}};
    EXPECT_NEAR(texture.sample(from_afar), 100.0F, 2.0F);
    u += 0.173F;
  }
}

TEST(Texture, AveragesAlongTheLongerAxisOnly) {
  Canvas stripes(64, 64, 0.0F);
  for (int v = 0; v < 64; v += 16) stripes.rectangle({0, v}, {64, v + 8}, 200.0);
  const Texture texture(stripes, 0.1);
  // Long along the stripes: they stay apart. Long across: they merge.
  const Footprint along{{3.0F, 0.4F}, {1.0F, 0.0F}, {0.0F, 0.1F}};
  const Footprint across{{3.0F, 0.4F}, {0.1F, 0.0F}, {0.0F, 1.6F}};
  EXPECT_NEAR(texture.sample(along), 200.0F, 5.0F);
  EXPECT_NEAR(texture.sample(across), 100.0F, 15.0F);
}

TEST(Texture, AnOddSideKeepsItsMean) {
  Canvas canvas(33, 17, 40.0F);
  canvas.rectangle({0, 0}, {16, 17}, 120.0);
  const Texture texture(canvas, 1.0);
  const Footprint whole{{16.0F, 8.0F}, {64.0F, 0.0F}, {0.0F, 64.0F}};
  EXPECT_NEAR(texture.sample(whole), 80.0F, 6.0F);
}

TEST(Canvas, DrawsEdgesWithTheShareThatTheyCover) {
  Canvas canvas(4, 4, 0.0F);
  canvas.rectangle({0.25, 0.0}, {2.0, 1.0}, 100.0);
  EXPECT_NEAR(canvas.at(0, 0), 75.0F, 1e-4F);
  EXPECT_NEAR(canvas.at(1, 0), 100.0F, 1e-4F);
  EXPECT_NEAR(canvas.at(2, 0), 0.0F, 1e-4F);
}

TEST(Canvas, WrapsAroundItsBorders) {
  Canvas canvas(8, 8, 0.0F);
  canvas.ellipse({{0.0, 0.0}, {2.0, 2.0}, 0.3}, 100.0);
  EXPECT_GT(canvas.at(7, 7), 90.0F);
  EXPECT_GT(canvas.at(0, 0), 90.0F);
  EXPECT_EQ(canvas.at(4, 4), 0.0F);
}

}  // namespace
}  // namespace oneac::simulation
