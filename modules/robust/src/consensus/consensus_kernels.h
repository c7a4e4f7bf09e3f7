#pragma once

#include "oneac/base/simd.h"

#include <cstddef>

namespace oneac::internal {

/// Point pairs, one array per coordinate. `weight` is 1, or 0 for the padding up to a whole number
/// of groups of kPointGroup.
template <class Number>
struct PointArrays {
  const Number* x1;
  const Number* y1;
  const Number* x2;
  const Number* y2;
  const Number* weight;
  std::size_t padded_size;  ///< a multiple of kPointGroup
};
constexpr std::size_t kPointGroup = 16;

/// The four entries of planar essential matrices that are not zero, one array per entry.
struct PlanarEssentials {
  const float* e12;
  const float* e21;
  const float* e23;
  const float* e32;
  std::size_t padded_size;  ///< a multiple of kPointGroup
};

/// A pose as the refinement reads it: row-major R, unit t, and the basis (T1, T2) of the directions
/// in which t may turn.
template <class Number>
struct PoseNumbers {
  Number R[9], t[3], T1[3], T2[3];
};

/// Σ over the points: cost, gradient and the upper triangle (row by row) of the Gauss–Newton matrix
/// with respect to (w, b), R ← exp([w]×) R, t ← t + b1 T1 + b2 T2.
template <class Number>
struct NormalSums {
  Number cost, g[5], H[15];
};

/// The loops over points, compiled once per instruction set; the same bits from each.
struct ConsensusKernels {
  /// cost[h] = Σ_points min(r²·inverse_squared_threshold, 1), r the Sampson distance, for each h.
  void (*planar_costs)(const PlanarEssentials& hypotheses, const PointArrays<float>& points,
                       float inverse_squared_threshold, float* cost);
  /// The same for one general E (row-major) over the groups [first, last).
  float (*msac)(const float* E, const PointArrays<float>& points, std::size_t first,
                std::size_t last, float inverse_squared_threshold);
  /// Geman–McClure ρ = r²/(r² + s²) on the Sampson distance. In single precision its gradient norm
  /// is held fixed in the derivative, which is exact where the residuals vanish.
  void (*normal_sums)(const PoseNumbers<float>& pose, const PointArrays<float>& points,
                      float squared_scale, NormalSums<float>& out);
  void (*normal_sums_double)(const PoseNumbers<double>& pose, const PointArrays<double>& points,
                             double squared_scale, NormalSums<double>& out);
  /// The same with H of Newton's method: a point counts by the curvature of its loss, (1 − 4ρ) of
  /// its weight, below zero for an outlier. H may be indefinite.
  void (*newton_sums)(const PoseNumbers<double>& pose, const PointArrays<double>& points,
                      double squared_scale, NormalSums<double>& out);
};

template <>
const ConsensusKernels& simd_kernels_at<ConsensusKernels, SimdLevel::kBaseline>();
template <>
const ConsensusKernels& simd_kernels_at<ConsensusKernels, SimdLevel::kAvx2>();
template <>
const ConsensusKernels& simd_kernels_at<ConsensusKernels, SimdLevel::kAvx512>();

}  // namespace oneac::internal
