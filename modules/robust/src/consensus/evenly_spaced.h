#pragma once

#include "oneac/solvers/span.h"

#include <cstddef>
#include <vector>

namespace oneac::internal {

/// At most `count` of the correspondences, evenly spaced.
[[nodiscard]] inline std::vector<AffineCorrespondence> evenly_spaced(AcSpan all,
                                                                     std::size_t count) {
  if (all.size() <= count) return {all.begin(), all.end()};
  std::vector<AffineCorrespondence> some(count);
  for (std::size_t k = 0; k < count; ++k) some[k] = all[k * all.size() / count];
  return some;
}

}  // namespace oneac::internal
