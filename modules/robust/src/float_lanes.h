#pragma once

#include <cstddef>
#include <cstdint>

// Included by one source per instruction set. Everything lives in an unnamed namespace and nothing
// inline of the standard library or Eigen is used: the linker must not take a function compiled for
// AVX as the one for all.
//
// A vector is as wide as the machine's registers; wider ones are taken apart element by element by
// the compiler. The number of partial sums is the same at every level: sums are taken in the same
// order everywhere and, without fused multiplications, come out with the same bits.
namespace oneac::internal {
namespace {

#if defined(__AVX512F__)
constexpr std::size_t kVectorBytes = 64;
#elif defined(__AVX__)
constexpr std::size_t kVectorBytes = 32;
#else
constexpr std::size_t kVectorBytes = 16;
#endif

typedef float FloatLanes __attribute__((vector_size(kVectorBytes)));
typedef double DoubleLanes __attribute__((vector_size(kVectorBytes)));

/// What a kernel needs to know of its lanes.
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
constexpr std::size_t kLanes = kVectorBytes / sizeof(Number);
/// Partial sums that a long sum is taken in: whole registers at every level.
template <class Number>
constexpr std::size_t kPartialSums = 64 / sizeof(Number);

template <class Number>
inline void load(const Number* from, typename LanesOf<Number>::Type& to) {
  __builtin_memcpy(&to, from, sizeof to);
}

template <class Number>
inline void store(const typename LanesOf<Number>::Type& from, Number* to) {
  __builtin_memcpy(to, &from, sizeof from);
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
inline Number sum(const Number* partial) {
  using Quarter = typename QuarterOf<Number>::Type;
  constexpr std::size_t kStep = kPartialSums<Number> / 4;
  Quarter q[4];
  for (std::size_t i = 0; i < 4; ++i) __builtin_memcpy(&q[i], partial + i * kStep, sizeof q[i]);
  return sum_of_quarter((q[0] + q[2]) + (q[1] + q[3]));
}

}  // namespace
}  // namespace oneac::internal
