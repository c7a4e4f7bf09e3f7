#include "patch_kernels.h"

namespace oneac::internal {

bool has_patch_level(PatchLevel level) {
#ifdef ONEAC_PATCH_X86
  if (level == PatchLevel::kAvx2) return __builtin_cpu_supports("avx2") != 0;
  if (level == PatchLevel::kAvx512) {
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
           __builtin_cpu_supports("avx512vl") != 0;
  }
#endif
  return level == PatchLevel::kBaseline;
}

const PatchKernels& patch_kernels(PatchLevel level) {
#ifdef ONEAC_PATCH_X86
  if (level == PatchLevel::kAvx512) return kPatchKernelsAvx512;
  if (level == PatchLevel::kAvx2) return kPatchKernelsAvx2;
#else
  static_cast<void>(level);
#endif
  return kPatchKernelsBaseline;
}

const PatchKernels& patch_kernels() {
  static const PatchKernels& best = []() -> const PatchKernels& {
    if (has_patch_level(PatchLevel::kAvx512)) return patch_kernels(PatchLevel::kAvx512);
    return patch_kernels(has_patch_level(PatchLevel::kAvx2) ? PatchLevel::kAvx2
                                                            : PatchLevel::kBaseline);
  }();
  return best;
}

}  // namespace oneac::internal
