#pragma once

#include "patch_template_loops.h"

// The kernels of patch_kernels.h for one width. A slice is what one register sees of each group of
// kPatchLanes samples; slices are worked off one after the other, so that partial sums stay in
// registers and every lane adds the same numbers in the same order at any width.
namespace oneac::internal {
namespace {

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

/// Σ w J Jᵀ for J given sample by sample: jacobian(i, J) fills kCount registers.
template <std::size_t kCount, class Jacobian>
inline void normal_matrix(const PatchWindow& window, const float* weight, float* upper,
                          const Jacobian& jacobian) {
  constexpr std::size_t kSums = kCount * (kCount + 1) / 2;
  PartialSums<kSums> sums;
  for (std::size_t slice = 0; slice < kPatchLanes; slice += kWidth) {
    Floats partial[kSums] = {};
    for (std::size_t i = slice; i < window.size; i += kPatchLanes) {
      Floats J[kCount];
      jacobian(i, J);
      const Floats w = load(weight + i);
      std::size_t k = 0;
      for (std::size_t row = 0; row < kCount; ++row) {
        const Floats weighted = w * J[row];
        for (std::size_t column = row; column < kCount; ++column) {
          partial[k++] += weighted * J[column];
        }
      }
    }
    for (std::size_t k = 0; k < kSums; ++k) sums.keep(k, slice, partial[k]);
  }
  for (std::size_t k = 0; k < kSums; ++k) upper[k] = sums[k];
}

inline void affine_normal(const PatchWindow& window, const PatchTemplate& patch,
                          const float* weight, float* upper) {
  const float inverse_radius = 1.0F / window.radius;
  normal_matrix<kAffineParameters>(window, weight, upper, [&](std::size_t i, Floats* J) {
    const Floats x = load(window.x + i) * inverse_radius, y = load(window.y + i) * inverse_radius;
    const Floats gx = load(patch.gx + i), gy = load(patch.gy + i);
    J[0] = gx * x;
    J[1] = gx * y;
    J[2] = gy * x;
    J[3] = gy * y;
    J[4] = gx;
    J[5] = gy;
    J[6] = load(patch.value + i);
    J[7] = Floats{} + 1.0F;
  });
}

inline void translation_normal(const PatchWindow& window, const PatchTemplate& patch,
                               const float* weight, float* upper) {
  normal_matrix<kTranslationParameters>(window, weight, upper, [&](std::size_t i, Floats* J) {
    J[0] = load(patch.gx + i);
    J[1] = load(patch.gy + i);
    J[2] = load(patch.value + i);
    J[3] = Floats{} + 1.0F;
  });
}

inline void tukey(const PatchWindow& window, const float* residual, float inverse_c,
                  float* weight) {
  for (std::size_t i = 0; i < window.size; i += kWidth) {
    const Floats ratio = load(residual + i) * inverse_c;
    const Floats inside = 1.0F - ratio * ratio;
    store(inside > 0.0F ? load(window.weight + i) * inside * inside : Floats{}, weight + i);
  }
}

constexpr PatchKernels kLoops{&make_template, &residuals, &affine_normal, &translation_normal,
                              &tukey};

}  // namespace
}  // namespace oneac::internal
