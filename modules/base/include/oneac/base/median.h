#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace oneac {

/// Middle of the sorted values, of an even number the upper of the two: always one of the values
/// (evaluation's percentile(values, 50) interpolates instead). Linear time, any unit.
/// @param values  no NaN among them
/// @throws std::invalid_argument  no values
[[nodiscard]] inline double upper_median(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("upper_median: values is empty, must not be");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace oneac
