#include "patch/patch_kernels.h"

#include "patch/patch_window.h"
#include "texture.h"

#include <gtest/gtest.h>

#include <cstring>
#include <utility>
#include <vector>

namespace oneac::internal {
namespace {

/// Everything the kernels of one level make of a random patch pair.
struct Outcome {
  std::vector<float> numbers;

  explicit Outcome(SimdLevel level) {
    const PatchKernels& kernels = simd_kernels<PatchKernels>(level);
    View second;
    second.A << 1.05, 0.02, -0.03, 0.98;
    const auto one = build_pyramid(render(Texture(21), View{}).view(), 2);
    const auto two = build_pyramid(render(Texture(21), second).view(), 2);
    constexpr std::pair<double, int> kWindows[] = {{6.0, 1},  {7.0, 1},  {8.0, 1},
                                                   {11.0, 2}, {14.0, 2}, {14.0, 1}};
    for (const auto& [radius, row_step] : kWindows) {
      const PatchWindow window = round_window(radius, row_step);
      PatchWarp here, there;
      here.centre = {201.3, 155.8};
      there.centre = second.map(here.centre);
      there.M = second.A;
      PatchTemplate patch{};
      kernels.make_template(*place(one, 0, here, radius + 1.0, 0.0), window, patch);
      keep(patch.value, window.size);
      keep(patch.gx, window.size);
      keep(patch.gy, window.size);
      AlignmentSums sums;
      alignas(64) float residual[kMaxSamples], weight[kMaxSamples];
      kernels.residuals(*place(two, 0, there, radius, 0.0), window, patch, window.weight,
                        patch.contrast, patch.mean, residual, sums);
      keep(residual, window.size);
      keep(sums.gradient, kAffineParameters);
      keep(&sums.squares, 1);
      keep(&sums.absolute, 1);
      kernels.tukey(window, residual, 4.0F, weight);
      keep(weight, window.size);
      kernels.make_template(*place(two, 0, there, radius + 1.0, 0.0), window, patch);
      keep(patch.value, window.size);
      keep(patch.gx, window.size);
      keep(patch.gy, window.size);
      keep_shift(kernels, one, two, here, there);
      float upper[36];
      kernels.affine_normal(window, patch, weight, upper);
      keep(upper, 36);
      kernels.translation_normal(window, patch, weight, upper);
      keep(upper, 10);
    }
  }

  void keep_shift(const PatchKernels& kernels, const ImagePyramid& one, const ImagePyramid& two,
                  const PatchWarp& here, const PatchWarp& there) {
    for (const double radius : {6.0, 8.0}) {
      const PatchWindow window = padded_window(radius);
      PatchTemplate patch{};
      kernels.make_template(*place(two, 0, there, radius + 1.0, 0.0), window, patch);
      keep(patch.value, window.size);
      AlignmentSums sums;
      kernels.shift_residuals(*place(one, 0, here, radius, 0.0), window, patch, patch.contrast,
                              patch.mean, sums);
      keep(sums.gradient, kAffineParameters);
      keep(&sums.squares, 1);
    }
  }

  void keep(const float* from, std::size_t count) {
    numbers.insert(numbers.end(), from, from + count);
  }
};

TEST(PatchKernels, GiveTheSameBytesAtEveryLevel) {
  const Outcome baseline(SimdLevel::kBaseline);
  for (const SimdLevel level : {SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (!is_supported(level)) {
      std::printf("level %d is not on this processor\n", static_cast<int>(level));
      continue;
    }
    const Outcome other(level);
    ASSERT_EQ(other.numbers.size(), baseline.numbers.size());
    EXPECT_EQ(std::memcmp(other.numbers.data(), baseline.numbers.data(),
                          baseline.numbers.size() * sizeof(float)),
              0)
        << static_cast<int>(level);
  }
}

TEST(PatchKernels, GiveTheSameSumsForAShiftAsForAllParameters) {
  const auto pyramid = build_pyramid(render(Texture(23), View{}).view(), 2);
  PatchWarp here, there;
  here.centre = {150.25, 140.5};
  there.centre = {151.0, 140.1};
  for (const double radius : {6.0, 8.0, 9.0}) {
    const PatchWindow window = padded_window(radius);
    PatchTemplate patch{};
    const PatchKernels& kernels = simd_kernels<PatchKernels>();
    kernels.make_template(*place(pyramid, 0, here, radius + 1.0, 0.0), window, patch);
    const SampleGrid grid = *place(pyramid, 0, there, radius, 0.0);
    AlignmentSums all, shift;
    alignas(64) float residual[kMaxSamples];
    kernels.residuals(grid, window, patch, window.weight, patch.contrast, patch.mean, residual,
                      all);
    kernels.shift_residuals(grid, window, patch, patch.contrast, patch.mean, shift);
    for (std::size_t k = 4; k < kAffineParameters; ++k) {
      EXPECT_NEAR(shift.gradient[k], all.gradient[k], 1e-3) << k;
    }
    EXPECT_NEAR(shift.squares, all.squares, 1e-3);
  }
}

TEST(PatchKernels, WarpTheTemplateAsTheResidualsWarpTheImage) {
  const auto pyramid = build_pyramid(render(Texture(24), View{}).view(), 2);
  const PatchWindow window = round_window(6.0);
  PatchWarp here;
  here.centre = {150.25, 140.5};
  here.M << 1.1, 0.1, -0.05, 0.9;
  PatchTemplate patch{};
  const PatchKernels& kernels = simd_kernels<PatchKernels>();
  kernels.make_template(*place(pyramid, 1, here, 7.0, 0.0), window, patch);
  AlignmentSums sums;
  alignas(64) float residual[kMaxSamples];
  kernels.residuals(*place(pyramid, 1, here, 6.0, 0.0), window, patch, window.weight,
                    patch.contrast, patch.mean, residual, sums);
  EXPECT_NEAR(sums.squares / window.weight_sum, 0.0, 1e-6);
}

TEST(PatchKernels, SumTheNormalMatrixOfAllParameters) {
  const auto pyramid = build_pyramid(render(Texture(25), View{}).view(), 2);
  const PatchWindow window = round_window(8.0);
  PatchWarp here;
  here.centre = {150.25, 140.5};
  PatchTemplate patch{};
  simd_kernels<PatchKernels>().make_template(*place(pyramid, 0, here, 9.0, 0.0), window, patch);
  double expected[kAffineParameters][kAffineParameters] = {};
  for (std::size_t i = 0; i < window.size; ++i) {
    const double x = window.x[i] / 8.0, y = window.y[i] / 8.0, gx = patch.gx[i], gy = patch.gy[i];
    const double J[] = {gx * x, gx * y, gy * x, gy * y, gx, gy, patch.value[i], 1.0};
    for (std::size_t row = 0; row < kAffineParameters; ++row) {
      for (std::size_t column = 0; column < kAffineParameters; ++column) {
        expected[row][column] += static_cast<double>(window.weight[i]) * J[row] * J[column];
      }
    }
  }
  float upper[36];
  simd_kernels<PatchKernels>().affine_normal(window, patch, window.weight, upper);
  std::size_t k = 0;
  for (std::size_t row = 0; row < kAffineParameters; ++row) {
    for (std::size_t column = row; column < kAffineParameters; ++column) {
      EXPECT_NEAR(upper[k++], expected[row][column], 1e-3) << row << ' ' << column;
    }
  }
}

TEST(PatchKernels, NormaliseTheTemplate) {
  const auto pyramid = build_pyramid(render(Texture(22), View{}).view(), 2);
  const PatchWindow window = round_window(11.0);
  PatchWarp here;
  here.centre = {150.25, 140.5};
  PatchTemplate patch{};
  simd_kernels<PatchKernels>().make_template(*place(pyramid, 0, here, 12.0, 0.0), window, patch);
  double sum = 0.0, squares = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < window.size; ++i) {
    const auto w = static_cast<double>(window.weight[i]), t = static_cast<double>(patch.value[i]);
    sum += w * t;
    squares += w * t * t;
    weights += w;
  }
  EXPECT_NEAR(sum / weights, 0.0, 1e-5);
  EXPECT_NEAR(squares / weights, 1.0, 1e-4);
}

TEST(ImagePyramid, KeepsPlacesFromLevelToLevel) {
  GreyImage image(160, 120, 20);
  for (int v = 60; v < 70; ++v) {
    for (int u = 40; u < 50; ++u) image.row(v)[u] = 220;
  }
  const ImagePyramid pyramid = build_pyramid(image.view(), 4);
  ASSERT_EQ(pyramid.levels.size(), 3U);  // the fourth would be smaller than a window
  for (const PyramidLevel& level : pyramid.levels) {
    const double scale = 160.0 / level.width;
    double mass = 0.0, u_sum = 0.0, v_sum = 0.0;
    for (int v = 0; v < level.height; ++v) {
      for (int u = 0; u < level.width; ++u) {
        const double grey = level.row(v)[u] / 16.0 - 20.0;
        mass += grey;
        u_sum += grey * u;
        v_sum += grey * v;
      }
    }
    EXPECT_NEAR(scale * u_sum / mass, 44.5, 0.1);
    EXPECT_NEAR(scale * v_sum / mass, 64.5, 0.1);
  }
}

}  // namespace
}  // namespace oneac::internal
