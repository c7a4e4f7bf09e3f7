#pragma once

#include "oneac/geometry/camera.h"

#include <Eigen/Core>

namespace oneac {

/// The same pixels by another camera: what becomes of normalised coordinates.
class CameraChange {
 public:
  CameraChange(const PinholeCamera& from, const PinholeCamera& to) : from_(from), to_(to) {}

  /// Normalised coordinates by `to` of the pixel that has x by `from`; as if `to` had no lens where
  /// its model folds over.
  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector2d& x) const;
  /// The derivative of that by x.
  [[nodiscard]] Eigen::Matrix2d derivative(const Eigen::Vector2d& x) const;
  /// How much longer normalised coordinates become by the focal length alone.
  [[nodiscard]] double factor() const { return from_.focal_px() / to_.focal_px(); }

 private:
  PinholeCamera from_, to_;
};

/// The camera of the same raw images that sees them `factor` times as far away: all angles to the
/// axis become as much smaller, whatever the lens does to them. Of five terms, see
/// is_five_term_lens().
[[nodiscard]] PinholeCamera with_longer_focal(PinholeCamera camera, double factor);

/// The pinhole camera nearest to what directions by `used` are in images undistorted by `raw`: they
/// have its focal length and principal point, and a little distortion.
/// @param given  of the undistorted images, by `raw`
[[nodiscard]] PinholeCamera pinhole_of(const PinholeCamera& given, const PinholeCamera& raw,
                                       const PinholeCamera& used);

}  // namespace oneac
