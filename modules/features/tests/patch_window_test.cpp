#include "patch/patch_window.h"

#include "patch/patch_alignment.h"
#include "patch/patch_kernels.h"
#include "texture.h"

#include <gtest/gtest.h>

namespace oneac::internal {
namespace {

TEST(PatchWindow, OfPaddedRowsWeighsLikeTheRoundOne) {
  const PatchWindow round = round_window(6.0), padded = padded_window(6.0);
  EXPECT_EQ(padded.size, 13U * kPatchLanes);
  EXPECT_NEAR(padded.weight_sum, round.weight_sum, 1e-4);
}

TEST(PatchWindow, LeavesOutEverySecondRow) {
  const PatchWindow all = round_window(11.0), half = round_window(11.0, 2);
  EXPECT_EQ(half.rows, 12U);
  EXPECT_EQ(half.reach(), all.reach());
  PatchTemplate every, second;
  const auto image = build_pyramid(render(Texture(27), View{}).view(), 1);
  PatchWarp here;
  here.centre = {201.3, 155.8};
  simd_kernels<PatchKernels>().make_template(*place(image, 0, here, 12.0, 0.0), all, every);
  simd_kernels<PatchKernels>().make_template(*place(image, 0, here, 12.0, 0.0), half, second);
  for (std::size_t i = 0, k = 0; i < half.size; ++i) {
    if (!(half.weight[i] > 0.0F)) continue;
    while (all.x[k] != half.x[i] || all.y[k] != half.y[i]) ASSERT_LT(++k, all.size);
    EXPECT_EQ(half.weight[i], all.weight[k]);
    EXPECT_NEAR(second.value[i] * second.contrast + second.mean,
                every.value[k] * every.contrast + every.mean, 0.01F);
    EXPECT_NEAR(second.gy[i] * second.contrast, every.gy[k] * every.contrast, 0.01F);
  }
}

TEST(PatchWindow, OfEverySecondRowDeterminesAnAffinityAsWell) {
  const PatchWindow all = round_window(14.0), half = round_window(14.0, 2);
  const auto image = build_pyramid(render(Texture(28), View{}).view(), 1);
  double ratio = 0.0;
  for (int i = 0; i < 20; ++i) {
    AnchoredPatch every, second;
    const Eigen::Vector2d u(60.0 + 17.0 * i, 80.0 + 9.0 * i);
    ASSERT_TRUE(anchor_patch(image, 0, all, u, every));
    ASSERT_TRUE(anchor_patch(image, 0, half, u, second));
    ratio += expected_affine_sigma(second) / expected_affine_sigma(every) / 20.0;
  }
  EXPECT_NEAR(ratio, 1.0, 0.05);
}

TEST(PatchWindow, HasTheSamplesOfADisc) {
  const PatchWindow window = round_window(8.0);
  EXPECT_EQ(window.rows, 17U);
  EXPECT_EQ(window.size % kPatchLanes, 0U);
  std::size_t used = 0;
  for (std::size_t i = 0; i < window.size; ++i) {
    if (!(window.weight[i] > 0.0F)) continue;
    ++used;
    EXPECT_LE(window.x[i] * window.x[i] + window.y[i] * window.y[i], 64.0F);
  }
  EXPECT_EQ(used, 197U);  // lattice points in a circle of radius 8
}

}  // namespace
}  // namespace oneac::internal
