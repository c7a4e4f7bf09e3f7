#pragma once

#include "oneac/solvers/span.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace oneac {

/// The point pairs of a set of correspondences, one array per coordinate in single precision: what
/// scoring reads, laid out for SIMD.
struct PointSet {
  explicit PointSet(AcSpan acs);

  [[nodiscard]] std::size_t size() const { return x1.size(); }

  std::vector<float> x1, y1, x2, y2;  ///< normalised [-]
};

/// MSAC cost of an essential matrix: Σ min(r², threshold²) / threshold², r the Sampson distance;
/// between 0 and the number of points. Stops early and returns a value ≥ `give_up` once the sum
/// reaches it.
/// @param threshold  [-] normalised image units
[[nodiscard]] double msac_cost(const Eigen::Matrix3d& E, const PointSet& points, double threshold,
                               double give_up);

/// Which point pairs lie within the threshold.
[[nodiscard]] std::vector<bool> sampson_inliers(const Eigen::Matrix3d& E, AcSpan acs,
                                                double threshold);

}  // namespace oneac
