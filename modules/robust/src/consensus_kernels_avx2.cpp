#include "consensus_kernels_body.h"

namespace oneac::internal {

const ConsensusKernels kKernelsAvx2 = kKernels;

}  // namespace oneac::internal
