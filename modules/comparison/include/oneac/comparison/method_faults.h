#pragma once

#include "oneac/comparison/pair_record.h"

#include <string>
#include <vector>

namespace oneac {

/// A line per method that gave answers which could not be used (they count as failures): how many,
/// and of the first few the pair and what was wrong.
[[nodiscard]] std::vector<std::string> method_faults(const ComparisonData& data);

}  // namespace oneac
