#include "consensus_kernels_body.h"

namespace oneac::internal {

const ConsensusKernels kKernelsAvx512 = kKernels;

}  // namespace oneac::internal
