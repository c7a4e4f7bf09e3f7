#pragma once

#include "oneac/calibration/camera_change.h"
#include "oneac/features/correspondence.h"

namespace oneac {

/// The lens that a drive has found, of images that were undistorted by the given one: what it does
/// beside the pinhole camera that is used for them.
class LearnedLens {
 public:
  /// @param given, used  pinhole cameras of the undistorted images
  /// @param raw_given, raw_used  cameras of the images as they are stored
  LearnedLens(const PinholeCamera& given, const PinholeCamera& used, const PinholeCamera& raw_given,
              const PinholeCamera& raw_used)
      : to_given_(used, given), lens_(raw_given, raw_used) {}

  /// The pair, normalised by the pinhole camera, as the lens sees it: points and affinities.
  [[nodiscard]] TrackedPair corrected(TrackedPair pair) const;

 private:
  /// The direction of x. @param J  its derivative
  [[nodiscard]] Eigen::Vector2d direction(const Eigen::Vector2d& x, Eigen::Matrix2d& J) const;

  CameraChange to_given_, lens_;
};

}  // namespace oneac
