#include "oneac/evaluation/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace oneac {
namespace {

double percentile_of_sorted(const std::vector<double>& sorted, double percent) {
  const double rank = percent / 100.0 * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (rank - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

double percentile(std::vector<double> values, double percent) {
  if (values.empty()) throw std::invalid_argument("percentile: values is empty, needs at least 1");
  if (!(percent >= 0.0 && percent <= 100.0)) {
    throw std::invalid_argument("percentile: percent = " + std::to_string(percent) +
                                ", must be 0 ... 100");
  }
  std::sort(values.begin(), values.end());
  return percentile_of_sorted(values, percent);
}

std::optional<Statistics> statistics_of(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const auto count = static_cast<double>(values.size());
  Statistics s;
  s.count = values.size();
  s.mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  s.median = percentile_of_sorted(sorted, 50.0);
  s.p95 = percentile_of_sorted(sorted, 95.0);
  s.rmse = std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) / count);
  s.max = sorted.back();
  return s;
}

}  // namespace oneac
