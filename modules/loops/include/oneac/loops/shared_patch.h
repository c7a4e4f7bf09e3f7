#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace oneac {

/// Where a keyframe saw a patch of the scene. Single precision: a ten-thousandth of a pixel, and a
/// drive has hundreds of them a keyframe.
struct PatchSighting {
  std::uint32_t keyframe = 0;                       ///< in the order of adding
  float point_sigma = 0.0F;                         ///< 1σ of a coordinate [-]
  float affine_sigma = 0.0F;                        ///< 1σ of an entry of A [-]; 0: as usual
  Eigen::Vector2f x = Eigen::Vector2f::Zero();      ///< [-]
  Eigen::Matrix2f A = Eigen::Matrix2f::Identity();  ///< ∂x/∂(x of the first sighting) [-]
};

/// A patch in the keyframes that saw it; the first one holds it.
using SharedPatch = std::vector<PatchSighting>;

}  // namespace oneac
