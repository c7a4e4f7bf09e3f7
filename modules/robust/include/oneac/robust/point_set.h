#pragma once

#include "oneac/solvers/span.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace oneac {

/// The point pairs of a set of correspondences, one array per coordinate, padded to whole vector
/// registers: what scoring (single precision) and polishing (double) read.
template <class Number>
struct BasicPointSet {
  BasicPointSet() = default;
  explicit BasicPointSet(AcSpan acs);

  [[nodiscard]] std::size_t size() const { return count; }

  std::vector<Number> x1, y1, x2, y2;  ///< normalised [-]; zero in the padding
  std::vector<Number> weight;          ///< 1, and 0 in the padding
  std::size_t count = 0;               ///< point pairs, without the padding
};
using PointSet = BasicPointSet<float>;
using PrecisePointSet = BasicPointSet<double>;

/// MSAC cost of an essential matrix: Σ min(r², threshold²) / threshold², r the Sampson distance;
/// between 0 and the number of points. Stops early and returns a value ≥ `give_up` once the sum
/// reaches it. The same bits on every machine.
/// @param threshold  [-] normalised image units
[[nodiscard]] double msac_cost(const Eigen::Matrix3d& E, const PointSet& points, double threshold,
                               double give_up);

}  // namespace oneac
