#pragma once

#include "oneac/base/simd.h"

#include <cstddef>
#include <cstdint>

namespace oneac::internal {

/// Sums of gradient products over the rows of a box, one entry per column.
struct GradientSums {
  std::int32_t *xx, *xy, *yy;
};

/// Loops along the rows of an image, compiled once per instruction set. Integers, and floating
/// point that no level sums in another order: the same bytes everywhere.
struct ImageRowKernels {
  /// above + 2 here + below.
  void (*sum_of_three)(const std::uint8_t* above, const std::uint8_t* here,
                       const std::uint8_t* below, std::size_t width, std::uint16_t* sums);
  /// (1 2 1) along sums that begin one column before the row.
  void (*smooth_along)(const std::uint16_t* sums, std::size_t width, std::uint16_t* out);
  /// (1 4 6 4 1) / 16 across five rows.
  void (*sum_of_five)(const std::uint16_t* const (&rows)[5], std::size_t width,
                      std::uint16_t* sums);
  /// The same along sums that begin two columns before the row, at every second column.
  void (*halve_along)(const std::uint16_t* sums, std::size_t width, std::uint16_t* out);
  /// Adds (sign 1) or takes away (−1) products of central differences; 12-bit grey.
  void (*add_gradients)(const std::uint16_t* above, const std::uint16_t* here,
                        const std::uint16_t* below, std::size_t width, std::int32_t sign,
                        const GradientSums& sums);
  /// Smaller eigenvalue of the sums over seven columns, out[3] for the first seven.
  void (*smaller_eigenvalues)(const GradientSums& sums, std::size_t width, float* out);
  /// Which of [begin, end) are at least `least` and the largest of their neighbours; of two equal
  /// ones the latter. Others get 0.
  void (*maxima)(const float* above, const float* here, const float* below, std::size_t begin,
                 std::size_t end, float least, std::int32_t* flags);
};

template <>
const ImageRowKernels& simd_kernels_at<ImageRowKernels, SimdLevel::kBaseline>();
template <>
const ImageRowKernels& simd_kernels_at<ImageRowKernels, SimdLevel::kAvx2>();
template <>
const ImageRowKernels& simd_kernels_at<ImageRowKernels, SimdLevel::kAvx512>();

}  // namespace oneac::internal
