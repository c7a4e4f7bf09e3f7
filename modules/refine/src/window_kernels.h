#pragma once

#include "oneac/base/simd.h"

#include <cstddef>

namespace oneac::internal {

constexpr std::size_t kPoseNumbers = 6;
constexpr std::size_t kPaddedPose = 8;  ///< whole registers at every level; zeros behind the six

/// A 6×6 block of the equations of the poses, column by column.
struct alignas(64) PoseBlockSum {
  double column[kPoseNumbers][kPaddedPose];
};

/// Six numbers of a pose.
struct alignas(64) PoseSum {
  double entry[kPaddedPose];
};

/// A landmark's coupling to a pose: a row for each of x, y, ρ.
struct alignas(64) CouplingSum {
  double row[3][kPaddedPose];
};

/// Derivatives of the two residuals of an observation by one pose.
struct alignas(64) PoseDerivative {
  double row[2][kPaddedPose];
};

/// The residuals and their derivatives by the landmark.
struct PointRow {
  double r[2];
  double J[2][3];
};

/// A landmark and a free view.
struct WindowLink {
  CouplingSum W;        ///< coupling block of the equations
  CouplingSum reduced;  ///< L⁻¹ W
  std::size_t view;     ///< index among the free ones
};

/// What remains of a landmark when it is eliminated: L⁻¹ of its damped equations, L⁻¹ g.
struct ReducedLandmark {
  double inverse_root[3][3];  ///< lower triangle
  double g[3];
};

/// What an observation adds to a block of the poses' equations: lowerᵀ upper. On the diagonal both
/// are one, and it adds upperᵀ r.
struct DerivativePair {
  const PoseDerivative* lower;
  const PoseDerivative* upper;
  const double* r;
};

/// What an eliminated landmark takes from a block: lowerᵀ upper. On the diagonal both are one, and
/// it adds upperᵀ g to the right side.
struct CouplingPair {
  const CouplingSum* lower;
  const CouplingSum* upper;
  const double* g;
};

/// Place of a block on or below the diagonal, row by row.
constexpr std::size_t block_at(std::size_t row, std::size_t column) {
  return row * (row + 1) / 2 + column;
}

/// The products that fill and reduce the equations of a window, compiled once per instruction set.
/// Every entry is a sum in the same order at every level: the same bytes.
struct WindowKernels {
  /// W += (∂r/∂landmark)ᵀ J.
  void (*add_coupling)(const PointRow& point, const PoseDerivative& J, CouplingSum& W);
  /// H += lowerᵀ upper, g += upperᵀ r of each, in their order; without g: off the diagonal.
  void (*add_pairs)(const DerivativePair* first, const DerivativePair* last, PoseBlockSum& H,
                    PoseSum* g);
  /// Sets `reduced` of the landmark's links.
  void (*reduce)(const ReducedLandmark& landmark, WindowLink* first, WindowLink* last);
  /// S −= lowerᵀ upper, rhs += upperᵀ g of each, in their order; without rhs: off the diagonal.
  void (*take_pairs)(const CouplingPair* first, const CouplingPair* last, PoseBlockSum& S,
                     PoseSum* rhs);
};

template <>
const WindowKernels& simd_kernels_at<WindowKernels, SimdLevel::kBaseline>();
template <>
const WindowKernels& simd_kernels_at<WindowKernels, SimdLevel::kAvx2>();
template <>
const WindowKernels& simd_kernels_at<WindowKernels, SimdLevel::kAvx512>();

}  // namespace oneac::internal
