#pragma once

#include "oneac/geometry/affine_correspondence.h"

#include <Eigen/Core>

#include <array>

namespace oneac {

/// A pinhole camera with OpenCV's plumb-bob distortion. Pixel centres at integer coordinates.
struct PinholeCamera {
  int width = 0;                       ///< [px]
  int height = 0;                      ///< [px]
  double fx = 1.0;                     ///< [px]
  double fy = 1.0;                     ///< [px]
  double cx = 0.0;                     ///< [px]
  double cy = 0.0;                     ///< [px]
  std::array<double, 5> distortion{};  ///< k1, k2, p1, p2, k3 [-]; all zero: rectified

  /// Any coefficient is not 0.
  [[nodiscard]] bool is_distorted() const;
  /// Geometric mean of fx and fy [px]: what turns normalised distances into pixels.
  [[nodiscard]] double focal_px() const;
  /// Pixel to normalised coordinates, ignoring distortion.
  [[nodiscard]] Eigen::Vector2d normalise(const Eigen::Vector2d& u) const;
  /// Normalised coordinates to pixel, ignoring distortion.
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector2d& x) const;
  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

/// A correspondence in pixels to normalised coordinates: x = K⁻¹ u, A = K2'⁻¹ A_px K1' with the
/// upper-left 2×2 blocks K'.
[[nodiscard]] AffineCorrespondence normalise(const AffineCorrespondence& ac_px,
                                             const PinholeCamera& first,
                                             const PinholeCamera& second);

}  // namespace oneac
