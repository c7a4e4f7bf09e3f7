#include "patch_perspective.h"

#include "patch_kernels.h"

#include <Eigen/LU>

#include <algorithm>
#include <cstddef>

namespace oneac::internal {

Eigen::Matrix2d perspective_shift(const float* normal, double radius) {
  const auto N = [normal](std::size_t row, std::size_t column) {
    const std::size_t low = std::min(row, column);
    const std::size_t before = low * kAffineParameters - low * (low + 1) / 2;
    return static_cast<double>(normal[before + std::max(row, column)]);
  };
  Eigen::Matrix2d shift, bent;
  shift << N(4, 4), N(4, 5), N(4, 5), N(5, 5);
  bent << N(0, 0) + N(0, 3), N(0, 1) + N(1, 3), N(0, 2) + N(2, 3), N(0, 3) + N(3, 3);
  return radius * radius * (shift.inverse() * bent);
}

}  // namespace oneac::internal
