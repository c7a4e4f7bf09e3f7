#pragma once

#include "oneac/features/correspondence.h"

#include <cstdint>
#include <vector>

namespace oneac {

/// The tracks of a pair, in its order.
inline std::vector<std::uint64_t> track_numbers(const TrackedPair& pair) {
  std::vector<std::uint64_t> numbers;
  numbers.reserve(pair.size());
  for (const Correspondence& ac : pair.correspondences) numbers.push_back(ac.track);
  return numbers;
}

}  // namespace oneac
