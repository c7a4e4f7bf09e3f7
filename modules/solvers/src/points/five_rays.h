#pragma once

#include "oneac/solvers/span.h"

#include <Eigen/Geometry>

#include <cstddef>

namespace oneac::internal {

/// Unit rays of the first five correspondences. @pre points.size() ≥ 5
struct FiveRays {
  Eigen::Vector3d first[5], second[5];

  explicit FiveRays(AcSpan points) {
    for (std::size_t i = 0; i < 5; ++i) {
      first[i] = points[i].x1.homogeneous().normalized();
      second[i] = points[i].x2.homogeneous().normalized();
    }
  }
};

}  // namespace oneac::internal
