#pragma once

#include <cstddef>
#include <cstdint>

// Included by one source per instruction set. Everything lives in an unnamed namespace and nothing
// inline of the standard library or Eigen is used: the linker must not take a function compiled for
// AVX as the one for all.
//
// The number of lanes is the same at every level; narrower machines take several instructions per
// operation. Sums are therefore taken in the same order everywhere and, without fused
// multiplications, come out with the same bits.
namespace oneac::internal {
namespace {

constexpr std::size_t kFloatLanes = 16;
constexpr std::size_t kDoubleLanes = 8;

typedef float FloatLanes __attribute__((vector_size(64)));
typedef double DoubleLanes __attribute__((vector_size(64)));

/// What a kernel needs to know of its lanes.
template <class Number>
struct LanesOf;
template <>
struct LanesOf<float> {
  using Type = FloatLanes;
  static constexpr std::size_t kCount = kFloatLanes;
};
template <>
struct LanesOf<double> {
  using Type = DoubleLanes;
  static constexpr std::size_t kCount = kDoubleLanes;
};

template <class Number>
inline void load(const Number* from, typename LanesOf<Number>::Type& to) {
  __builtin_memcpy(&to, from, sizeof to);
}

/// Sum of the lanes, halves first: the same order whatever the machine.
template <class Number>
inline Number sum(const typename LanesOf<Number>::Type& lanes) {
  Number values[LanesOf<Number>::kCount];
  __builtin_memcpy(values, &lanes, sizeof lanes);
  for (std::size_t half = LanesOf<Number>::kCount / 2; half > 0; half /= 2) {
    for (std::size_t i = 0; i < half; ++i) values[i] += values[i + half];
  }
  return values[0];
}

}  // namespace
}  // namespace oneac::internal
