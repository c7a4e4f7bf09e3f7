#pragma once

#include "oneac/base/simd.h"

#include <cstddef>
#include <cstdint>

namespace oneac {

/// Borrowed affine correspondences as a structure of arrays, `size` entries each: fields as in
/// AffineCorrespondence, x1 = (x1, y1), x2 = (x2, y2), A = [a11 a12; a21 a22] = ∂x2/∂x1 [-].
struct AcArrays {
  const double* x1 = nullptr;
  const double* y1 = nullptr;
  const double* x2 = nullptr;
  const double* y2 = nullptr;
  const double* a11 = nullptr;
  const double* a12 = nullptr;
  const double* a21 = nullptr;
  const double* a22 = nullptr;
  std::size_t size = 0;
};

/// Where the poses go, one entry per correspondence: fields as in PlanarPose. `valid` is 1 where
/// the scalar solver returns a pose and 0 where it returns an empty set; there the identity is
/// written, never NaN. The arrays must not overlap with each other or with the input.
struct PlanarPoseArrays {
  double* cos_alpha = nullptr;
  double* sin_alpha = nullptr;
  double* tx = nullptr;
  double* tz = nullptr;
  std::uint8_t* valid = nullptr;
};

/// relpose_1ac_ground of every correspondence, several at a time.
///
/// Equal to the scalar solver within 1e-9, and empty for the same correspondences: those within
/// rounding of a threshold, or slow to converge, are handed to the scalar solver. Each result
/// depends on its own correspondence only. No level fuses multiplications with additions, so that
/// the levels agree in practice; what is promised is 1e-9, not equal bits.
/// @return  how many are valid
/// @throws  std::invalid_argument an array is null although size > 0, or the level is not supported
/// @cost    see tests/bench/solvers; no allocation; thread-safe
std::size_t relpose_1ac_ground_batch(const AcArrays& acs, const PlanarPoseArrays& poses,
                                     SimdLevel level = best_simd_level());

/// The same for relpose_1ac_planar.
std::size_t relpose_1ac_planar_batch(const AcArrays& acs, const PlanarPoseArrays& poses,
                                     SimdLevel level = best_simd_level());

}  // namespace oneac
