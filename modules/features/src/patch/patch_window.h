#pragma once

#include "image_pyramid.h"
#include "patch_kernels.h"

#include <Eigen/Core>

#include <optional>

namespace oneac::internal {

/// A round window; the weight falls from 1 in the centre to 1/2 on the rim, so that what lies
/// farther from the point counts less and entering samples do not jump. With row_step 2 every
/// second row is left out. @pre floor(radius) is a multiple of row_step, or odd and row_step 2
[[nodiscard]] PatchWindow round_window(double radius, int row_step = 1);
/// The same with rows of equal length, a multiple of kPatchLanes: outside the disc the weight is 0.
/// Samples can then be read as they lie in the image. @pre radius below 10
[[nodiscard]] PatchWindow padded_window(double radius);

/// How a patch of one image lies in another, in pixels of level 0: d becomes M d + centre; and its
/// brightness, I2 = gain I1 + bias.
struct PatchWarp {
  Eigen::Matrix2d M = Eigen::Matrix2d::Identity();
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double gain = 1.0;
  double bias = 0.0;  ///< [1/16 grey]
};

/// Pixels of level 0 per pixel of a level.
[[nodiscard]] inline double level_scale(std::size_t level) {
  return static_cast<double>(1U << level);
}

/// Where the samples of a window fall in a level. Empty when any would lie more than `margin`
/// pixels outside the image.
[[nodiscard]] std::optional<SampleGrid> place(const ImagePyramid& pyramid, std::size_t level,
                                              const PatchWarp& warp, double radius, double margin);

}  // namespace oneac::internal
