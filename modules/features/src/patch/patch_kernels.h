#pragma once

#include "oneac/base/simd.h"

#include <cstddef>
#include <cstdint>

namespace oneac::internal {

/// Sums run in this many partial sums, whatever the width of the machine's registers, and are then
/// added in a fixed order: the same bytes at every level.
constexpr std::size_t kPatchLanes = 16;
constexpr std::size_t kMaxSamples = 640;
constexpr std::size_t kMaxRows = 29;  ///< side of the largest window [px]
constexpr std::size_t kOverrun = 16;  ///< room for the register that ends behind the last sample
constexpr std::size_t kAffineParameters = 8;       ///< A (row by row), shift, gain, bias
constexpr std::size_t kTranslationParameters = 4;  ///< shift, gain, bias

/// Samples of a round window around a point. Unused samples at the end have weight 0.
struct PatchWindow {
  std::size_t size = 0;  ///< multiple of kPatchLanes
  float radius = 0.0F;   ///< [px]
  float weight_sum = 0.0F;
  std::size_t rows = 0;             ///< the samples come row by row
  std::size_t row_step = 1;         ///< [px] from a row to the next
  std::size_t row_begin[kMaxRows];  ///< first column of a row, from the left of the square one
                                    ///< pixel wider than the window
  std::size_t row_size[kMaxRows];

  /// [px] of the outermost rows from the centre.
  [[nodiscard]] int reach() const { return static_cast<int>((rows - 1) * row_step / 2); }

  alignas(64) float x[kMaxSamples];       ///< [px]
  alignas(64) float y[kMaxSamples];       ///< [px]
  alignas(64) float weight[kMaxSamples];  ///< [-]
};

/// Where samples are taken: pixel of the window's point d is A d + (u, v) + origin. u, v hold the
/// fraction of a pixel and an offset that keeps them positive over the window.
struct SampleGrid {
  const std::uint16_t* data;
  std::int32_t origin;  ///< index of the pixel that u = v = 0 means
  std::int32_t stride;  ///< [pixels]
  float a11, a12, a21, a22, u, v;
};

/// A patch with mean 0 and standard deviation 1 over the window, and its gradient.
struct PatchTemplate {
  float mean = 0.0F;      ///< [1/16 grey]
  float contrast = 0.0F;  ///< standard deviation [1/16 grey]
  alignas(64) float value[kMaxSamples + kOverrun];
  alignas(64) float gx[kMaxSamples + kOverrun];  ///< [1/px]
  alignas(64) float gy[kMaxSamples + kOverrun];  ///< [1/px]
};

/// What one pass over the window gives: Σ w r J for the parameters in the order above, J for A in
/// units of the window's radius.
struct AlignmentSums {
  float gradient[kAffineParameters];
  float squares = 0.0F;   ///< Σ w r²
  float absolute = 0.0F;  ///< Σ w |r|
};

/// The loops over samples, compiled once per instruction set.
struct PatchKernels {
  /// Samples image and gradient (per pixel of the window) at the grid and normalises.
  void (*make_template)(const SampleGrid& grid, const PatchWindow& window, PatchTemplate& patch);
  /// r = (image − bias) / gain − template, into `residual`, and the sums with the given weights.
  void (*residuals)(const SampleGrid& grid, const PatchWindow& window, const PatchTemplate& patch,
                    const float* weight, float gain, float bias, float* residual,
                    AlignmentSums& sums);
  /// The same with the window's weights for shift, gain and bias only, faster: the sums for A and
  /// the absolute ones are 0. A must be the identity, the window one of padded rows.
  void (*shift_residuals)(const SampleGrid& grid, const PatchWindow& window,
                          const PatchTemplate& patch, float gain, float bias, AlignmentSums& sums);
  /// Σ w J Jᵀ, upper triangle row by row: 36 and 10 numbers.
  void (*affine_normal)(const PatchWindow& window, const PatchTemplate& patch, const float* weight,
                        float* upper);
  void (*translation_normal)(const PatchWindow& window, const PatchTemplate& patch,
                             const float* weight, float* upper);
  /// Tukey's weights times the window's: w (1 − (r/c)²)² inside c, 0 outside.
  void (*tukey)(const PatchWindow& window, const float* residual, float inverse_c, float* weight);
};

template <>
const PatchKernels& simd_kernels_at<PatchKernels, SimdLevel::kBaseline>();
template <>
const PatchKernels& simd_kernels_at<PatchKernels, SimdLevel::kAvx2>();
template <>
const PatchKernels& simd_kernels_at<PatchKernels, SimdLevel::kAvx512>();

}  // namespace oneac::internal
