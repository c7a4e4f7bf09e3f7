#include "consensus_kernels.h"

namespace oneac::internal {

const ConsensusKernels& consensus_kernels(SimdLevel level) {
#ifdef ONEAC_BATCH_X86
  if (level == SimdLevel::kAvx512) return kKernelsAvx512;
  if (level == SimdLevel::kAvx2) return kKernelsAvx2;
#else
  static_cast<void>(level);
#endif
  return kKernelsBaseline;
}

}  // namespace oneac::internal
