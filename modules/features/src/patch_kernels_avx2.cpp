#define ONEAC_PATCH_WIDTH 8
#include "patch_loops.h"

namespace oneac::internal {

const PatchKernels kPatchKernelsAvx2 = kLoops;

}  // namespace oneac::internal
