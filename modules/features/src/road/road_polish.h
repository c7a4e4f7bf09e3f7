#pragma once

#include "road_equations.h"
#include "road_grid.h"

#include <array>

namespace oneac::internal {

/// What is known beside the images: z is measured from `start`, the length is free.
struct RoadPrior {
  RoadMotion start;
  RoadTangents tangents;
  RoadMatrix information = RoadMatrix::Zero();  ///< of z; nothing about the length
  double heave = 0.0;                           ///< [heights] 1σ of the camera's rise
};

/// A motion fitted to the road.
struct RoadFit {
  bool converged = false;
  RoadMotion motion;
  RoadVector z = RoadVector::Zero();
  RoadMatrix covariance = RoadMatrix::Zero();
  RoadEquations equations;
  std::array<double, kBlocks> weight{};     ///< [0, 1] agreement of a block
  std::array<double, kBlocks> evidence{};   ///< [1/heights²] of its length, times its weight
  std::array<double, kBlocks> deviation{};  ///< [σ] of its own length from that of all
  int blocks = 0;                           ///< that count and agree
  double agreeing = 0.0;                    ///< [-] share of the evidence of blocks that agree
  double scatter = 1.0;  ///< [-] χ² per degree of freedom of the blocks' lengths, at least 1
};

/// A maximum of the search. [heights]
struct RoadPeak {
  double length = 0.0;
  double reach = 0.0;  ///< a fit that ends farther away is another one's
};

/// Gauss-Newton from the coarsest given level to the finest one, blocks weighted by agreement.
[[nodiscard]] RoadFit polish(const RoadContext& context, const RoadGrid& grid, std::size_t coarsest,
                             const RoadPrior& prior, const RoadPeak& peak,
                             const RoadAlignmentOptions& options);

}  // namespace oneac::internal
