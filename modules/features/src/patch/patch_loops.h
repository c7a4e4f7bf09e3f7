#pragma once

#include "patch_normal_loops.h"

// The kernels of patch_kernels.h for one width. A slice is what one register sees of each group of
// kPatchLanes samples; slices are worked off one after the other, so that partial sums stay in
// registers and every lane adds the same numbers in the same order at any width.
namespace oneac::internal {
namespace {

// NOLINTNEXTLINE(readability-function-size): PatchKernels decides on the parameters.
inline void residuals(const SampleGrid& grid, const PatchWindow& window, const PatchTemplate& patch,
                      const float* weight, float gain, float bias, float* residual,
                      AlignmentSums& out) {
  PartialSums<10> sums;
  const float inverse_gain = 1.0F / gain, inverse_radius = 1.0F / window.radius;
  for (std::size_t slice = 0; slice < kPatchLanes; slice += kWidth) {
    Floats a11 = {}, a12 = {}, a21 = {}, a22 = {}, u = {}, v = {}, g = {}, b = {};
    Floats squares = {}, absolute = {};
    for (std::size_t i = slice; i < window.size; i += kPatchLanes) {
      const Floats x = load(window.x + i), y = load(window.y + i);
      const Floats value = load(patch.value + i);
      const Floats r = (sample(grid, x, y) - bias) * inverse_gain - value;
      store(r, residual + i);
      const Floats wr = load(weight + i) * r;
      const Floats along_x = wr * load(patch.gx + i), along_y = wr * load(patch.gy + i);
      a11 += along_x * x;
      a12 += along_x * y;
      a21 += along_y * x;
      a22 += along_y * y;
      u += along_x;
      v += along_y;
      g += wr * value;
      b += wr;
      squares += wr * r;
      absolute += magnitude(wr);
    }
    sums.keep(0, slice, a11 * inverse_radius);
    sums.keep(1, slice, a12 * inverse_radius);
    sums.keep(2, slice, a21 * inverse_radius);
    sums.keep(3, slice, a22 * inverse_radius);
    sums.keep(4, slice, u);
    sums.keep(5, slice, v);
    sums.keep(6, slice, g);
    sums.keep(7, slice, b);
    sums.keep(8, slice, squares);
    sums.keep(9, slice, absolute);
  }
  for (std::size_t k = 0; k < kAffineParameters; ++k) out.gradient[k] = sums[k];
  out.squares = sums[8];
  out.absolute = sums[9];
}

inline void shift_residuals(const SampleGrid& grid, const PatchWindow& window,
                            const PatchTemplate& patch, float gain, float bias,
                            AlignmentSums& out) {
  const ShiftedRows rows(grid, window.reach());
  PartialSums<5> sums;
  const float inverse_gain = 1.0F / gain;
  const std::size_t width = window.row_size[0];
  for (std::size_t slice = 0; slice < kPatchLanes; slice += kWidth) {
    Floats u = {}, v = {}, g = {}, b = {}, squares = {};
    for (std::size_t x = slice; x < width; x += kPatchLanes) {
      Floats top = rows.along(0, x);
      for (std::size_t y = 0; y < window.rows; ++y) {
        const Floats bottom = rows.along(y + 1, x);
        const std::size_t i = y * width + x;
        const Floats value = load(patch.value + i);
        const Floats r = (rows.between(top, bottom) - bias) * inverse_gain - value;
        const Floats wr = load(window.weight + i) * r;
        u += wr * load(patch.gx + i);
        v += wr * load(patch.gy + i);
        g += wr * value;
        b += wr;
        squares += wr * r;
        top = bottom;
      }
    }
    sums.keep(0, slice, u);
    sums.keep(1, slice, v);
    sums.keep(2, slice, g);
    sums.keep(3, slice, b);
    sums.keep(4, slice, squares);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    out.gradient[k] = 0.0F;
    out.gradient[4 + k] = sums[k];
  }
  out.squares = sums[4];
  out.absolute = 0.0F;
}

inline void tukey(const PatchWindow& window, const float* residual, float inverse_c,
                  float* weight) {
  for (std::size_t i = 0; i < window.size; i += kWidth) {
    const Floats ratio = load(residual + i) * inverse_c;
    const Floats inside = 1.0F - ratio * ratio;
    store(inside > 0.0F ? load(window.weight + i) * inside * inside : Floats{}, weight + i);
  }
}

constexpr PatchKernels kPatchKernels{&make_template, &residuals,          &shift_residuals,
                                     &affine_normal, &translation_normal, &tukey};

}  // namespace

template <>
const PatchKernels& simd_kernels_at<PatchKernels, kSimdLevel>() {
  return kPatchKernels;
}

}  // namespace oneac::internal
