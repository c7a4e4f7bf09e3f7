#pragma once

#include "patch_template_loops.h"

// Normal matrices, for patch_loops.h.
namespace oneac::internal {
namespace {

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

/// Σ w p q of products of gradient and place: rows of the affine normal matrix share them. First
/// the 18 of two gradients, then the 15 of the others, so that the sums of a pass stay in
/// registers. Each pass stores its sums in the order in which affine_normal() places them.
inline void gradient_moments(const PatchWindow& window, const PatchTemplate& patch,
                             const float* weight, float* moments) {
  PartialSums<18> sums;
  const float inverse_radius = 1.0F / window.radius;
  for (std::size_t slice = 0; slice < kPatchLanes; slice += kWidth) {
    Floats partial[18] = {};
    for (std::size_t i = slice; i < window.size; i += kPatchLanes) {
      const Floats x = load(window.x + i) * inverse_radius, y = load(window.y + i) * inverse_radius;
      const Floats gx = load(patch.gx + i), gy = load(patch.gy + i), w = load(weight + i);
      const Floats products[3] = {w * gx * gx, w * gx * gy, w * gy * gy};
      for (std::size_t k = 0; k < 3; ++k) {
        const Floats with_x = products[k] * x, with_y = products[k] * y;
        Floats* out = partial + 6 * k;
        out[0] += with_x * x;
        out[1] += with_x * y;
        out[2] += with_y * y;
        out[3] += with_x;
        out[4] += with_y;
        out[5] += products[k];
      }
    }
    for (std::size_t k = 0; k < 18; ++k) sums.keep(k, slice, partial[k]);
  }
  for (std::size_t k = 0; k < 18; ++k) moments[k] = sums[k];
}

inline void light_moments(const PatchWindow& window, const PatchTemplate& patch,
                          const float* weight, float* moments) {
  PartialSums<15> sums;
  const float inverse_radius = 1.0F / window.radius;
  for (std::size_t slice = 0; slice < kPatchLanes; slice += kWidth) {
    Floats partial[15] = {};
    for (std::size_t i = slice; i < window.size; i += kPatchLanes) {
      const Floats x = load(window.x + i) * inverse_radius, y = load(window.y + i) * inverse_radius;
      const Floats value = load(patch.value + i), w = load(weight + i), wv = w * value;
      const Floats gx = load(patch.gx + i), gy = load(patch.gy + i);
      const Floats products[4] = {wv * gx, wv * gy, w * gx, w * gy};
      for (std::size_t k = 0; k < 4; ++k) {
        partial[3 * k] += products[k] * x;
        partial[3 * k + 1] += products[k] * y;
        partial[3 * k + 2] += products[k];
      }
      partial[12] += wv * value;
      partial[13] += wv;
      partial[14] += w;
    }
    for (std::size_t k = 0; k < 15; ++k) sums.keep(k, slice, partial[k]);
  }
  for (std::size_t k = 0; k < 15; ++k) moments[k] = sums[k];
}

inline void affine_normal(const PatchWindow& window, const PatchTemplate& patch,
                          const float* weight, float* upper) {
  // Which moment each entry is: J = (gx x, gx y, gy x, gy y, gx, gy, value, 1).
  constexpr std::uint8_t kMoment[] = {0,  1,  6,  7,  3,  9,  18, 24,  //
                                      2,  7,  8,  4,  10, 19, 25,      //
                                      12, 13, 9,  15, 21, 27,          //
                                      14, 10, 16, 22, 28,              //
                                      5,  11, 20, 26,                  //
                                      17, 23, 29,                      //
                                      30, 31,                          //
                                      32};
  float moments[33];
  gradient_moments(window, patch, weight, moments);
  light_moments(window, patch, weight, moments + 18);
  for (std::size_t k = 0; k < sizeof kMoment; ++k) upper[k] = moments[kMoment[k]];
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

}  // namespace
}  // namespace oneac::internal
