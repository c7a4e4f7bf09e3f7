#pragma once

#include "patch_kernels.h"

#include "oneac/base/simd_lanes.h"

namespace oneac::internal {
namespace {

constexpr std::size_t kWidth = kLanes<float>;
static_assert(kPatchLanes == kPartialSums<float>);

using Floats = FloatLanes;
using Ints = IntLanes;
using Bits = BitLanes;

// The address sanitizer does not watch gathers: its builds load one lane after the other.
#ifdef __SANITIZE_ADDRESS__
#define ONEAC_PATCH_GATHER 0
#else
#define ONEAC_PATCH_GATHER 1
#endif

/// Two neighbouring pixels of 16 bits per lane: the left one in the lower half.
inline Bits load_pairs(const std::uint16_t* data, const Ints& index) {
#if ONEAC_SIMD_BYTES == 64 && ONEAC_PATCH_GATHER
  return reinterpret_cast<Bits>(_mm512_mask_i32gather_epi32(
      _mm512_setzero_si512(), 0xFFFF, reinterpret_cast<__m512i>(index), data, 2));
#elif ONEAC_SIMD_BYTES == 32 && ONEAC_PATCH_GATHER
  return reinterpret_cast<Bits>(_mm256_i32gather_epi32(reinterpret_cast<const int*>(data),
                                                       reinterpret_cast<__m256i>(index), 2));
#else
  Bits pairs;
  for (std::size_t i = 0; i < kWidth; ++i) {
    std::uint32_t pair;
    __builtin_memcpy(&pair, data + index[i], sizeof pair);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    pair = (pair >> 16) | (pair << 16);
#endif
    pairs[i] = pair;
  }
  return pairs;
#endif
}

/// Neighbouring pixels.
inline Floats load_row(const std::uint16_t* from) {
#if ONEAC_SIMD_BYTES == 64
  __m256i words;  // the generic conversion below takes twice the instructions here
  __builtin_memcpy(&words, from, sizeof words);
  return __builtin_convertvector(reinterpret_cast<Ints>(_mm512_maskz_cvtepu16_epi32(0xFFFF, words)),
                                 Floats);
#else
  typedef std::uint16_t Pixels __attribute__((vector_size(ONEAC_SIMD_BYTES / 2)));
  Pixels pixels;
  __builtin_memcpy(&pixels, from, sizeof pixels);
  return __builtin_convertvector(__builtin_convertvector(pixels, Ints), Floats);
#endif
}

inline Floats to_floats(const Bits& bits) {
  return __builtin_convertvector(reinterpret_cast<const Ints&>(bits), Floats);
}

/// Bilinear interpolation at pixel (u, v) of the grid. @pre u, v ≥ 0
inline Floats interpolate(const SampleGrid& grid, const Floats& u, const Floats& v) {
  const Ints column = __builtin_convertvector(u, Ints);
  const Ints row = __builtin_convertvector(v, Ints);
  const Floats fu = u - __builtin_convertvector(column, Floats);
  const Floats fv = v - __builtin_convertvector(row, Floats);
  const Ints index = row * grid.stride + column + grid.origin;
  const Bits upper = load_pairs(grid.data, index);
  const Bits lower = load_pairs(grid.data, index + grid.stride);
  const Floats upper_left = to_floats(upper & 0xFFFFU);
  const Floats lower_left = to_floats(lower & 0xFFFFU);
  const Floats top = upper_left + fu * (to_floats(upper >> 16) - upper_left);
  const Floats bottom = lower_left + fu * (to_floats(lower >> 16) - lower_left);
  return top + fv * (bottom - top);
}

inline Floats sample(const SampleGrid& grid, const Floats& x, const Floats& y) {
  return interpolate(grid, grid.a11 * x + grid.a12 * y + grid.u,
                     grid.a21 * x + grid.a22 * y + grid.v);
}

}  // namespace
}  // namespace oneac::internal
