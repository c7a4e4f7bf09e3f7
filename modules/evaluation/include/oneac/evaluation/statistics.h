#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace oneac {

/// What is said about a set of errors, in the unit of its values.
struct Statistics {
  std::size_t count = 0;
  double mean = 0.0;
  double median = 0.0;
  double p95 = 0.0;  ///< 95 % percentile
  double rmse = 0.0;
  double max = 0.0;
};

/// Percentile with linear interpolation between the two nearest ranks (numpy's default).
/// @param percent  0 … 100
/// @throws std::invalid_argument when there are no values or the percentage is out of its bounds
[[nodiscard]] double percentile(std::vector<double> values, double percent);

/// Empty when there are no values. @pre all values are finite
[[nodiscard]] std::optional<Statistics> statistics_of(const std::vector<double>& values);

}  // namespace oneac
