#include "consensus_kernels_body.h"

namespace oneac::internal {

const ConsensusKernels kKernelsBaseline = kKernels;

}  // namespace oneac::internal
