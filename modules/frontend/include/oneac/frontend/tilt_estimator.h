#pragma once

#include "oneac/frontend/front_end_options.h"
#include "oneac/geometry/leveling.h"

#include <Eigen/Core>

#include <deque>

namespace oneac {

/// The rotation that levels the camera: a given tilt, its pitch corrected by the drive.
///
/// A vehicle travels along its road, so in a levelled camera the translation has no vertical part;
/// the median of its elevation over the recent steps is the error of the given pitch. Roll is not
/// observable from the direction of travel and stays as given.
class TiltEstimator {
 public:
  TiltEstimator(const Tilt& given, const TiltOptions& options);

  /// Learns from a translation of the (tilted) camera; steps that are not mainly forward are
  /// ignored.
  void add_step(const Eigen::Vector3d& t_cam);

  [[nodiscard]] Tilt tilt() const;
  /// R_level_cam of the present tilt.
  [[nodiscard]] Eigen::Matrix3d leveling() const { return leveling_rotation(tilt()); }
  /// Correction of the given pitch [rad].
  [[nodiscard]] double correction() const { return correction_; }

 private:
  Tilt given_;
  TiltOptions options_;
  std::deque<double> elevations_;  ///< [rad] of the direction of travel, by the given tilt
  double correction_ = 0.0;
};

}  // namespace oneac
