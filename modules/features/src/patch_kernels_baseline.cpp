#define ONEAC_PATCH_WIDTH 4
#include "patch_loops.h"

namespace oneac::internal {

const PatchKernels kPatchKernelsBaseline = kLoops;

}  // namespace oneac::internal
