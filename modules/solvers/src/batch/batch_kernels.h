#pragma once

#include "oneac/base/simd.h"

#include <cstddef>
#include <cstdint>

namespace oneac::internal {

/// x1, y1, x2, y2, a11, a12, a21, a22.
struct BatchInput {
  const double* entry[8];
};

/// What a kernel says about a correspondence.
enum BatchStatus : std::uint8_t {
  kBatchEmpty = 0,
  kBatchSolved = 1,
  kBatchUndecided = 2  ///< within rounding of a threshold, or slow to converge: ask the scalar form
};

/// cos α, sin α, tx, tz, and a BatchStatus. Where there is no pose the identity is written.
struct BatchOutput {
  double* entry[4];
  std::uint8_t* status;
};

using BatchKernel = void (*)(const BatchInput& in, const BatchOutput& out, std::size_t size);

/// The batch solvers, compiled once per instruction set.
struct BatchKernels {
  BatchKernel ground, planar;
};

template <>
const BatchKernels& simd_kernels_at<BatchKernels, SimdLevel::kBaseline>();
template <>
const BatchKernels& simd_kernels_at<BatchKernels, SimdLevel::kAvx2>();
template <>
const BatchKernels& simd_kernels_at<BatchKernels, SimdLevel::kAvx512>();

}  // namespace oneac::internal
