#pragma once

#include "road_grid.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace oneac::internal {

/// Unknowns: length, pitch and roll of the normal, rotation w (in b), direction (in its plane).
constexpr int kUnknowns = 8;
using RoadVector = Eigen::Matrix<double, kUnknowns, 1>;
using RoadMatrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

/// Directions in b in which normal and direction of travel may change.
struct RoadTangents {
  Eigen::Matrix<double, 3, 2> normal;  ///< by pitch and by roll [1/rad]
  Eigen::Matrix<double, 3, 2> travel;
};

/// The motion whose unknowns differ from `start` by z (the length included).
[[nodiscard]] RoadMotion moved(const RoadMotion& start, const RoadTangents& tangents,
                               const RoadVector& z);

/// What one block of road says about the unknowns.
struct BlockEquations {
  /// Σ w J Jᵀ; gain, a shift across the road and each line's bias eliminated, noise discounted
  RoadMatrix H = RoadMatrix::Zero();
  RoadVector g = RoadVector::Zero();  ///< Σ w J r: the step is −H⁻¹ g
  double variance = 0.0;              ///< [grey²] of a residual
  double weights = 0.0;               ///< Σ w
  double gain = 1.0;                  ///< b over a
  double rho = 0.0;                   ///< correlation without what is the same along the road
  double lag = 0.0;                   ///< correlation of residuals of neighbours on a line
  int samples = 0;
};
using RoadEquations = std::array<BlockEquations, kBlocks>;

/// Normal equations of all blocks at a motion. Robust weights by the residuals of the block before.
/// @param before  equations of the step before, for gain and scale of the weights; gain ≤ 0: none
[[nodiscard]] RoadEquations road_equations(const RoadContext& context, const RoadGrid& grid,
                                           const RoadLook<GreySample>& look,
                                           const RoadMotion& motion, const RoadTangents& tangents,
                                           const RoadEquations& before);

}  // namespace oneac::internal
