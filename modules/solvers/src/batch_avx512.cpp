#define ONEAC_BATCH_LANES 8
#include "batch_driver.h"

namespace oneac::internal {

void ground_batch_avx512(const BatchInput& in, const BatchOutput& out, std::size_t size) {
  drive<ground_poses>(in, out, size);
}

void planar_batch_avx512(const BatchInput& in, const BatchOutput& out, std::size_t size) {
  drive<planar_poses>(in, out, size);
}

}  // namespace oneac::internal
