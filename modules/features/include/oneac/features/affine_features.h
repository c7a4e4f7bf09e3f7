#pragma once

#include <Eigen/Core>

#include <vector>

namespace oneac {

/// An affine-covariant frame: maps the unit circle of the normalised patch into the image,
/// u = shape p + centre.
struct AffineFrame {
  Eigen::Vector2d centre;  ///< [px]
  Eigen::Matrix2d shape;   ///< [px], orientation included
};

/// Frames of one image with one descriptor each.
struct AffineFeatures {
  /// One row per frame. RootSIFT: non-negative, unit length.
  using Descriptors = Eigen::Matrix<float, Eigen::Dynamic, 128, Eigen::RowMajor>;

  std::vector<AffineFrame> frames;
  Descriptors descriptors;
};

}  // namespace oneac
