#pragma once

#include "thresholds.h"

#include <cstddef>
#include <cstdint>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

// Included by one source per instruction set, which defines ONEAC_BATCH_LANES. Everything lives in
// an unnamed namespace and nothing inline of the standard library or Eigen is used: the linker
// must not take a function compiled for AVX as the one for all.
namespace oneac::internal {
namespace {

constexpr std::size_t kLanes = ONEAC_BATCH_LANES;

/// kLanes numbers, and as many masks (all bits or none).
typedef double Lanes __attribute__((vector_size(8 * ONEAC_BATCH_LANES)));
typedef std::int64_t Mask __attribute__((vector_size(8 * ONEAC_BATCH_LANES)));

inline Lanes all(double value) {
  Lanes lanes;
  for (std::size_t i = 0; i < kLanes; ++i) lanes[i] = value;
  return lanes;
}

inline Lanes load(const double* from) {
  Lanes lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

inline void store(const Lanes& lanes, double* to) {
  __builtin_memcpy(to, &lanes, sizeof lanes);
}

inline Lanes square_root(const Lanes& x) {
#if ONEAC_BATCH_LANES == 8
  return static_cast<Lanes>(_mm512_mask_sqrt_pd(x, 0xFF, x));  // the plain form warns in GCC 12
#elif ONEAC_BATCH_LANES == 4
  return static_cast<Lanes>(_mm256_sqrt_pd(x));
#elif defined(__x86_64__)
  return static_cast<Lanes>(_mm_sqrt_pd(x));
#else
  Lanes roots;
  for (std::size_t i = 0; i < kLanes; ++i) roots[i] = __builtin_sqrt(x[i]);
  return roots;
#endif
}

inline Lanes magnitude(const Lanes& x) {
  return x < 0.0 ? -x : x;
}

inline bool any(const Mask& mask) {
#if ONEAC_BATCH_LANES == 4
  return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask)) != 0;
#else
  std::int64_t bits = 0;
  for (std::size_t i = 0; i < kLanes; ++i) bits |= mask[i];
  return bits != 0;
#endif
}

/// One correspondence per lane: x1 = (x, y), x2 = (u, v), A = [a1 a2; a3 a4].
struct AcLanes {
  Lanes x, y, u, v, a1, a2, a3, a4;

  /// Finite, not mirrored, as is_usable().
  [[nodiscard]] Mask usable() const {
    const Lanes zero = x * 0.0 + y * 0.0 + u * 0.0 + v * 0.0 + a1 * 0.0 + a2 * 0.0 + a3 * 0.0 +
                       a4 * 0.0;  // NaN when any is not finite
    return (zero == 0.0) & (a1 * a4 - a2 * a3 > 0.0);
  }
};

/// One pose per lane. `empty` and `solved` exclude each other; where neither is set the scalar
/// solver has to decide.
struct PoseLanes {
  Lanes cos_alpha, sin_alpha, tx, tz;
  Mask empty, solved;
};

}  // namespace
}  // namespace oneac::internal
