#pragma once

#include "oneac/frontend/tilt_belief.h"

#include <optional>

namespace oneac {

/// What one step of the camera says about its pitch against the road.
struct PitchStep {
  AngleBelief turn;     ///< pitch up of the second view relative to the first
  double length = 0.0;  ///< [m] driven
  /// Of the axis above the direction of travel, in the middle of the step; empty when the images
  /// do not tell, or the camera did not travel forward.
  std::optional<AngleBelief> travel;
};

/// Pitch of the camera against its road, frame by frame: the mounting and what the springs add.
///
/// Kalman filter with one state. From frame to frame the pitch changes by the turn that the images
/// show, less what the road's slope changes (random walk over the way). It is measured by the
/// elevation of travel. What the springs add is the difference to the slow tilt of TiltEstimator.
class SuspensionPitch {
 public:
  /// @param mounting  pitch of the camera on the level vehicle
  explicit SuspensionPitch(const AngleBelief& mounting);

  void add_step(const PitchStep& step);
  /// A measurement of the pitch against the road at the newest frame.
  void add_measurement(const AngleBelief& pitch);
  /// A step that the images did not tell about: the springs are at rest again, more or less.
  /// @param mounting  as believed now
  void lose(const AngleBelief& mounting);

  /// [rad] axis above the road, at the newest frame.
  [[nodiscard]] const AngleBelief& pitch() const { return pitch_; }

 private:
  AngleBelief pitch_;
};

}  // namespace oneac
