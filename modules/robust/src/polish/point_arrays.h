#pragma once

#include "consensus/consensus_kernels.h"

#include "oneac/robust/point_set.h"

namespace oneac::internal {

/// A point set as the kernels read it.
template <class Number>
[[nodiscard]] PointArrays<Number> arrays_of(const BasicPointSet<Number>& points) {
  return {points.x1.data(), points.y1.data(),     points.x2.data(),
          points.y2.data(), points.weight.data(), points.x1.size()};
}

}  // namespace oneac::internal
