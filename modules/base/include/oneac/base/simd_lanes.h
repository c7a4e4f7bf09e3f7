#pragma once

#include "oneac/base/simd.h"

#include <cstddef>
#include <cstdint>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

// Vectors as wide as the registers of one level, for the files that oneac_simd() of CMake compiles
// once per level and for nothing else. Everything lives in an unnamed namespace and nothing inline
// of the standard library or Eigen is used there: the linker must not take a function compiled for
// AVX as the one for all.
//
// The number of partial sums is the same at every level: sums are taken in the same order
// everywhere and, without fused multiplications, come out with the same bits.
#ifndef ONEAC_SIMD_BYTES
#define ONEAC_SIMD_BYTES 16
#endif

namespace oneac::internal {
namespace {

constexpr SimdLevel kSimdLevel = ONEAC_SIMD_BYTES == 64   ? SimdLevel::kAvx512
                                 : ONEAC_SIMD_BYTES == 32 ? SimdLevel::kAvx2
                                                          : SimdLevel::kBaseline;

typedef float FloatLanes __attribute__((vector_size(ONEAC_SIMD_BYTES)));
typedef double DoubleLanes __attribute__((vector_size(ONEAC_SIMD_BYTES)));
typedef std::int32_t IntLanes __attribute__((vector_size(ONEAC_SIMD_BYTES)));
typedef std::uint32_t BitLanes __attribute__((vector_size(ONEAC_SIMD_BYTES)));
/// Of doubles: all bits or none.
typedef std::int64_t MaskLanes __attribute__((vector_size(ONEAC_SIMD_BYTES)));

template <class Number>
struct LanesOf;
template <>
struct LanesOf<float> {
  using Type = FloatLanes;
};
template <>
struct LanesOf<double> {
  using Type = DoubleLanes;
};

/// Numbers in a register.
template <class Number>
constexpr std::size_t kLanes = ONEAC_SIMD_BYTES / sizeof(Number);
/// Partial sums that a long sum is taken in: whole registers at every level.
template <class Number>
constexpr std::size_t kPartialSums = 64 / sizeof(Number);

inline FloatLanes load(const float* from) {
  FloatLanes lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
inline DoubleLanes load(const double* from) {
  DoubleLanes lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

inline void store(const FloatLanes& lanes, float* to) {
  __builtin_memcpy(to, &lanes, sizeof lanes);
}
inline void store(const DoubleLanes& lanes, double* to) {
  __builtin_memcpy(to, &lanes, sizeof lanes);
}

inline FloatLanes magnitude(const FloatLanes& x) {
  return x < 0.0F ? -x : x;
}
inline DoubleLanes magnitude(const DoubleLanes& x) {
  return x < 0.0 ? -x : x;
}

inline DoubleLanes all(double value) {
  DoubleLanes lanes;
  for (std::size_t i = 0; i < kLanes<double>; ++i) lanes[i] = value;
  return lanes;
}

inline DoubleLanes square_root(const DoubleLanes& x) {
#if ONEAC_SIMD_BYTES == 64
  return static_cast<DoubleLanes>(
      _mm512_mask_sqrt_pd(x, 0xFF, x));  // the plain form warns in GCC 12
#elif ONEAC_SIMD_BYTES == 32
  return static_cast<DoubleLanes>(_mm256_sqrt_pd(x));
#elif defined(__x86_64__)
  return static_cast<DoubleLanes>(_mm_sqrt_pd(x));
#else
  DoubleLanes roots;
  for (std::size_t i = 0; i < kLanes<double>; ++i) roots[i] = __builtin_sqrt(x[i]);
  return roots;
#endif
}

inline bool any(const MaskLanes& mask) {
#if ONEAC_SIMD_BYTES == 32
  return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask)) != 0;
#else
  std::int64_t bits = 0;
  for (std::size_t i = 0; i < kLanes<double>; ++i) bits |= mask[i];
  return bits != 0;
#endif
}

/// A quarter of the partial sums.
template <class Number>
struct QuarterOf;
template <>
struct QuarterOf<float> {
  typedef float Type __attribute__((vector_size(16)));
};
template <>
struct QuarterOf<double> {
  typedef double Type __attribute__((vector_size(16)));
};

inline float sum_of_quarter(const QuarterOf<float>::Type& q) {
  return (q[0] + q[2]) + (q[1] + q[3]);
}
inline double sum_of_quarter(const QuarterOf<double>::Type& q) {
  return q[0] + q[1];
}

/// Sum of the partial sums, halves first.
template <class Number>
inline Number total(const Number* partial) {
  using Quarter = typename QuarterOf<Number>::Type;
  constexpr std::size_t kStep = kPartialSums<Number> / 4;
  Quarter q[4];
  for (std::size_t i = 0; i < 4; ++i) __builtin_memcpy(&q[i], partial + i * kStep, sizeof q[i]);
  return sum_of_quarter((q[0] + q[2]) + (q[1] + q[3]));
}

}  // namespace
}  // namespace oneac::internal
