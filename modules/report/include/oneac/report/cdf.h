#pragma once

#include "oneac/report/plot.h"

#include <string>
#include <vector>

namespace oneac {

/// The values of one method; infinite ones keep its curve below one.
struct Sample {
  std::string label;
  std::vector<double> values;
};

/// Cumulative distributions over a logarithmic axis, which spans whole decades from the 1 % to the
/// 99.5 % value of all: a stray value does not squeeze the rest. Values that are not positive count
/// as its left end.
[[nodiscard]] Plot cdf_plot(const std::string& title, const std::string& x_label,
                            const std::vector<Sample>& samples);

/// The labels of series over the same abscissae that lie on each other: nowhere more than
/// `tolerance` apart. One group per curve that hides others.
[[nodiscard]] std::vector<std::vector<std::string>> coinciding(const Plot& plot, double tolerance);

}  // namespace oneac
