#pragma once

#include "oneac/solvers/span.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace oneac {

/// Pairs (i < j) of correspondences that are neighbours in both views.
using NeighbourPairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Neighbours by a grid over the four coordinates (x1, y1, x2, y2): those that share a cell, at
/// most the next kMaxNeighbours of them so that a crowded cell costs no square.
///
/// The box around the first view's points is cut into `cells` per axis; the second view uses the
/// same box, points beyond it count to its border cells. Reference: the grid of the authors' own
/// GC-RANSAC, 8 cells per axis.
/// @throws std::invalid_argument when cells is not within 1 … 1000
[[nodiscard]] NeighbourPairs grid_neighbours(AcSpan acs, int cells);

constexpr std::size_t kMaxNeighbours = 10;

/// Which correspondences are inliers when neighbours tend to share their label: the global minimum
/// of E(L) = Σ_p B(L_p) + λ Σ_pq R(L_p, L_q) by one graph cut.
///
/// Model: K_p = exp(−r_p² / 2ε²); B(inlier) = 1 − K_p, B(outlier) = K_p; R(different) = 1,
/// R(outliers) = (K_p + K_q) / 2, R(inliers) = 1 − (K_p + K_q) / 2.
/// Source: Barath and Matas, "Graph-Cut RANSAC", CVPR 2018, eqs. (2) to (5).
/// The graph is built once, a cut only fills in the capacities. Not thread-safe: one per thread.
class SpatialCut {
 public:
  /// @param weight  λ ≥ 0; without it the label is K_p > 1/2
  SpatialCut(std::size_t size, const NeighbourPairs& neighbours, double weight);
  ~SpatialCut();
  SpatialCut(const SpatialCut&) = delete;
  SpatialCut& operator=(const SpatialCut&) = delete;

  /// @param squared_errors  r_p² / ε², one each, ≥ 0 or infinite
  /// @param labels          resized; 1 for inliers
  /// @return                number of inliers
  std::size_t label(const std::vector<double>& squared_errors, std::vector<std::uint8_t>& labels);

 private:
  struct Graph;
  std::unique_ptr<Graph> graph_;
};

}  // namespace oneac
