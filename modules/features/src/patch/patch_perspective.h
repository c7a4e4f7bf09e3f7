#pragma once

#include <Eigen/Core>

namespace oneac::internal {

/// Correspondence::perspective of a patch: (Σ w g gᵀ)⁻¹ Σ w g (g·δ) δᵀ [px²]. Both sums stand in
/// the normal matrix of its affine alignment, as products of the columns of the shift and of A.
/// What A, gain and bias take of a perspective warp is odd in δ and left out.
/// @param normal  upper triangle, row by row, of kAffineParameters
/// @param radius  [px] of the window, the unit of A's columns
[[nodiscard]] Eigen::Matrix2d perspective_shift(const float* normal, double radius);

}  // namespace oneac::internal
