#pragma once

namespace oneac {

/// Instruction sets that kernels are compiled for: registers of 16, 32 and 64 bytes.
enum class SimdLevel { kBaseline, kAvx2, kAvx512 };

/// Whether this processor (and this build) can run the level. The baseline always runs.
[[nodiscard]] bool is_supported(SimdLevel level);

/// The widest level that is supported.
[[nodiscard]] SimdLevel best_simd_level();

namespace internal {

/// A table of functions compiled for one level. A module declares the three specialisations
/// beside its struct `Kernels` and defines them in the one file that oneac_simd() of CMake
/// compiles per level (base/simd_lanes.h).
template <class Kernels, SimdLevel kLevel>
[[nodiscard]] const Kernels& simd_kernels_at();

/// @pre is_supported(level)
template <class Kernels>
[[nodiscard]] const Kernels& simd_kernels(SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::kAvx512) return simd_kernels_at<Kernels, SimdLevel::kAvx512>();
  if (level == SimdLevel::kAvx2) return simd_kernels_at<Kernels, SimdLevel::kAvx2>();
#else
  static_cast<void>(level);
#endif
  return simd_kernels_at<Kernels, SimdLevel::kBaseline>();
}

/// Those of the widest level.
template <class Kernels>
[[nodiscard]] const Kernels& simd_kernels() {
  static const Kernels& best = simd_kernels<Kernels>(best_simd_level());
  return best;
}

}  // namespace internal
}  // namespace oneac
