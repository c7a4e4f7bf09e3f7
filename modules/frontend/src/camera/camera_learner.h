#pragma once

#include "camera/learned_lens.h"
#include "camera/turn_learner.h"

#include "oneac/calibration/intrinsics_belief.h"
#include "oneac/frontend/camera_belief.h"
#include "oneac/frontend/front_end_options.h"
#include "oneac/frontend/keyframe.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// What the bends of a drive say about its camera: collects keyframes, measures a window when it
/// holds a bend, and says which camera to use, whether the given one can be right, and how far it
/// is to be doubted. The one owner of that: turns by other sensors come in here, too.
class CameraLearner {
 public:
  explicit CameraLearner(const SelfCalibrationOptions& options) : options_(options) {}

  /// The camera of the drive's images, as given.
  /// @param raw  of the images as they are stored; without size what is learned is the lens of the
  ///             undistorted ones, and so it is of a lens of other than five terms unless
  ///             `refine` is "full"
  void start(const PinholeCamera& given, const PinholeCamera& raw = {});
  /// The next keyframe. @return whether the camera to use has changed
  bool follow(const NewestKeyframe& keyframe, std::size_t index, double time_s);
  /// Turns by other sensors, in order of time, see TurnLearner. Not used while f is not learned.
  void add_yaw_rate(double time_s, double rate);
  void add_course(double time_s, double course, double speed);
  /// The next frame of the drive, and whether the images told its step.
  void add_frame(double time_s, bool carried);
  /// What has become final. @return whether the camera to use has changed
  bool follow_turns(const std::vector<SettledFrame>& settled, const Tilt& tilt);
  /// Measures what still waits at the end of a drive. The camera to use stays.
  void finish();

  [[nodiscard]] const CameraBelief& belief() const { return belief_; }
  [[nodiscard]] const PinholeCamera& used() const { return belief_.used; }
  /// What the lens does beside used(), once it has been learned.
  [[nodiscard]] std::optional<LearnedLens> lens() const;
  /// Why the given focal length cannot be right, with the cure.
  [[nodiscard]] std::optional<std::string> fault() const;

 private:
  /// @return whether something was learned
  bool measure(const CalibrationWindow& window);
  [[nodiscard]] IntrinsicsPrior prior() const;
  /// Bends and what other sensors tell, together.
  void conclude();
  /// @return whether the camera to use has changed
  bool move();
  /// Of good cameras the bends of one in twenty say that they are.
  [[nodiscard]] bool lens_is_doubtful() const;
  [[nodiscard]] bool learns() const { return options_.refine != "off"; }

  SelfCalibrationOptions options_;
  std::optional<IntrinsicsBelief> intrinsics_;
  WindowCutter cutter_;
  CameraBelief belief_;
  TurnLearner turns_;
  PinholeCamera raw_;  ///< as given: what changes are counted from
  IntrinsicsVector change_ = IntrinsicsVector::Zero();
  bool confirmed_ = false;       ///< more than one voice tells the focal length
  double accused_sigmas_ = 0.0;  ///< the given focal length is so many σ away from what accuses it
  bool scales_ = true;           ///< another focal length alone stretches the image
  bool contradicted_ = false;    ///< once: from then on the focal length follows what is learned
  bool moves_lens_ = false;      ///< once: from then on all of the camera does
  std::size_t index_ = 0;        ///< image of the newest keyframe
  double time_s_ = 0.0;          ///< of it [s]
};

}  // namespace oneac
