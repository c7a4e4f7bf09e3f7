#include "oneac/base/simd.h"

namespace oneac {

bool is_supported(SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::kAvx2) return __builtin_cpu_supports("avx2") != 0;
  if (level == SimdLevel::kAvx512) {
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
           __builtin_cpu_supports("avx512vl") != 0;
  }
#endif
  return level == SimdLevel::kBaseline;
}

SimdLevel best_simd_level() {
  if (is_supported(SimdLevel::kAvx512)) return SimdLevel::kAvx512;
  return is_supported(SimdLevel::kAvx2) ? SimdLevel::kAvx2 : SimdLevel::kBaseline;
}

}  // namespace oneac
