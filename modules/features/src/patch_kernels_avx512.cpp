#define ONEAC_PATCH_WIDTH 16
#include "patch_loops.h"

namespace oneac::internal {

const PatchKernels kPatchKernelsAvx512 = kLoops;

}  // namespace oneac::internal
