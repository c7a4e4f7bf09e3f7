#pragma once

#include "oneac/calibration/intrinsics_belief.h"
#include "oneac/frontend/camera_belief.h"
#include "oneac/frontend/front_end_options.h"
#include "oneac/frontend/keyframe.h"

#include <cstddef>
#include <optional>
#include <string>

namespace oneac {

/// What the bends of a drive say about its camera: collects keyframes, measures a window when it
/// holds a bend, and says which camera to use and whether the given one can be right.
class CameraLearner {
 public:
  explicit CameraLearner(const SelfCalibrationOptions& options) : options_(options) {}

  /// The camera of the drive's images, as given.
  void start(const PinholeCamera& given);
  /// The next keyframe. @return whether the camera to use has changed
  bool follow(const NewestKeyframe& keyframe, std::size_t index, double time_s);
  /// Measures what still waits at the end of a drive. The camera to use stays.
  void finish();

  [[nodiscard]] const CameraBelief& belief() const { return belief_; }
  [[nodiscard]] const PinholeCamera& used() const { return belief_.used; }
  /// Why the given focal length cannot be right, with the cure.
  [[nodiscard]] std::optional<std::string> fault() const;

 private:
  /// @return whether something was learned
  bool measure(const CalibrationWindow& window);
  [[nodiscard]] IntrinsicsPrior prior() const;
  /// Bends confirm each other, and the given focal length is so many of their σ away.
  [[nodiscard]] bool contradicts(double sigmas) const;

  SelfCalibrationOptions options_;
  std::optional<IntrinsicsBelief> intrinsics_;
  WindowCutter cutter_;
  CameraBelief belief_;
  IntrinsicsVector change_ = IntrinsicsVector::Zero();
  bool contradicted_ = false;  ///< once: from then on the camera follows what is learned
  std::size_t index_ = 0;      ///< image of the newest keyframe
  double time_s_ = 0.0;        ///< of it [s]
};

}  // namespace oneac
