#pragma once

#include "oneac/geometry/affine_correspondence.h"

#include <Eigen/Core>

#include <array>
#include <optional>

namespace oneac {

/// What a lens does to a pinhole's picture, as in OpenCV and MRPT.
enum class LensModel {
  plumb_bob,  ///< k1 k2 p1 p2 k3 and the rational model's k4 k5 k6
  kannala_brandt,  ///< fisheye: k1 k2 k3 k4 of the angle, θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸)
};

/// A pinhole camera and its lens. Pixel centres at integer coordinates.
struct PinholeCamera {
  int width = 0;                       ///< [px]
  int height = 0;                      ///< [px]
  double fx = 1.0;                     ///< [px]
  double fy = 1.0;                     ///< [px]
  double cx = 0.0;                     ///< [px]
  double cy = 0.0;                     ///< [px]
  std::array<double, 8> distortion{};  ///< in the lens model's order [-]
  LensModel lens = LensModel::plumb_bob;

  /// A fisheye, or any coefficient is not 0; else the images are rectified.
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

/// The camera of the same images resized. Empty when either size is not known or the aspect is
/// another: each side may be rounded to whole pixels.
[[nodiscard]] std::optional<PinholeCamera> resized(const PinholeCamera& camera, int width,
                                                   int height);

/// A correspondence in pixels to normalised coordinates: x = K⁻¹ u, A = K2'⁻¹ A_px K1' with the
/// upper-left 2×2 blocks K'.
[[nodiscard]] AffineCorrespondence normalise(const AffineCorrespondence& ac_px,
                                             const PinholeCamera& first,
                                             const PinholeCamera& second);

}  // namespace oneac
