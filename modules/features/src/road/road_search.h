#pragma once

#include "road_grid.h"

#include <array>
#include <vector>

namespace oneac::internal {

/// What one length explains.
struct RoadScore {
  double length = 0.0;               ///< [heights]
  double evidence = 0.0;             ///< Σ ½ n log 1/(1 − ρ²), n of independent samples
  std::array<float, kBlocks> rho{};  ///< per block [-]; 0 where there is nothing to compare
};

/// Which lengths are tried.
struct LengthRange {
  double low = 0.0, high = 0.0, step = 0.0;  ///< [heights]
};

/// Blocks of the template whose grey values change along the road by more than noise.
[[nodiscard]] std::array<bool, kBlocks> textured_blocks(const RoadGrid& grid,
                                                        const std::vector<float>& values,
                                                        double noise_grey);

/// A search looks at every so many-th line along the road: enough to find the place.
constexpr int kSearchStride = 4;

/// Correlates the template with the image as it is seen at a length.
[[nodiscard]] RoadScore score_length(const RoadContext& context, const RoadGrid& grid,
                                     const RoadLook<float>& look, const RoadMotion& motion);

/// Local maxima of the evidence over the range, best first, at most `most`.
[[nodiscard]] std::vector<RoadScore> search_lengths(const RoadContext& context,
                                                    const RoadGrid& grid,
                                                    const RoadLook<float>& look,
                                                    const RoadMotion& motion,
                                                    const LengthRange& range, std::size_t most);

}  // namespace oneac::internal
