#pragma once

#include "oneac/geometry/affine_correspondence.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace oneac {

/// A depth that was measured otherwise than by the motion of the camera.
struct MeasuredDepth {
  double z = 0.0;      ///< [m] along the optical axis
  double sigma = 0.0;  ///< relative 1σ
};

/// One per correspondence, where it is known.
using PointDepths = std::vector<std::optional<MeasuredDepth>>;

/// An affine correspondence of two images with all that is known of it, from the tracker to the
/// map. Image units are those of its pair: pixels out of the tracker, where A = ∂u2/∂u1, and
/// normalised after normalised().
struct Correspondence : AffineCorrespondence {
  std::uint64_t track = 0;    ///< the same in every pair the track lives through, never used twice
  double point_sigma = 0.0;   ///< 1σ of a coordinate of x2 [image unit]; 0 where unknown
  double affine_sigma = 0.0;  ///< 1σ of an entry of A [-]; 0 where unknown
  /// K [image unit²]: a patch that maps as δ ↦ A δ (1 − η·δ), which perspective does, is found with
  /// its centre x2 shifted by −A K η; zero where unknown.
  Eigen::Matrix2d perspective = Eigen::Matrix2d::Zero();
  /// x2 less where the tracker goes on from: what the perspective correction has moved it by.
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();
  std::uint8_t grey = 0;               ///< of the second image there; 0 before it is looked up
  std::optional<MeasuredDepth> depth;  ///< of the point in the second view
};

/// Correspondences from the frame before to this one, each part of a track over many frames.
struct TrackedPair {
  std::vector<Correspondence> correspondences;
  bool standing = false;  ///< the images are near-identical: the camera stood

  /// Of correspondences.
  [[nodiscard]] std::size_t size() const { return correspondences.size(); }
  [[nodiscard]] bool empty() const { return correspondences.empty(); }
};

/// Points and affinities alone, as solvers take them.
[[nodiscard]] inline std::vector<AffineCorrespondence> affine_parts(const TrackedPair& pair) {
  return {pair.correspondences.begin(), pair.correspondences.end()};
}

/// 1σ of a coordinate of each correspondence [image unit], 0 where unknown; empty where all are.
[[nodiscard]] inline std::vector<double> point_sigmas(const TrackedPair& pair) {
  std::vector<double> sigmas;
  bool known = false;
  for (const Correspondence& ac : pair.correspondences) {
    sigmas.push_back(ac.point_sigma);
    known = known || ac.point_sigma > 0.0;
  }
  return known ? sigmas : std::vector<double>{};
}

}  // namespace oneac
