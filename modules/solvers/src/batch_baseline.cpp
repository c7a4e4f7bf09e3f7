#define ONEAC_BATCH_LANES 2
#include "batch_driver.h"

namespace oneac::internal {

void ground_batch_baseline(const BatchInput& in, const BatchOutput& out, std::size_t size) {
  drive<ground_poses>(in, out, size);
}

void planar_batch_baseline(const BatchInput& in, const BatchOutput& out, std::size_t size) {
  drive<planar_poses>(in, out, size);
}

}  // namespace oneac::internal
