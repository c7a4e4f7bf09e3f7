#pragma once

#include "calibrate/camera_height.h"
#include "calibrate/turn_reference.h"
#include "run/drive_record.h"
#include "run/run_options.h"

#include "oneac/calibration/intrinsics_belief.h"

#include <optional>
#include <string>
#include <vector>

namespace oneac::app {

/// How to calibrate.
struct CalibrateOptions {
  RunOptions run;
  std::string output;             ///< camera.ini
  std::optional<double> fov_deg;  ///< horizontal field of view that somebody guesses
  bool fisheye = false;           ///< of such a guess: Kannala and Brandt's lens
  int passes = 4;  ///< over the drive, at most: each tracks with the camera of the last

  /// @throws InputError naming flag, value and bound
  void validate();
};

/// A camera out of a drive.
struct Calibration {
  PinholeCamera guess;
  IntrinsicsPrior prior;
  IntrinsicsEstimate estimate;
  std::vector<IntrinsicsMeasurement> bends;  ///< of the last pass
  std::vector<CalibrationWindow> windows;    ///< the same
  std::vector<TurnEvidence> turns;           ///< by other sensors, of the last pass
  std::vector<std::string> agreeing;         ///< of these sensors, those that count
  std::vector<std::string> contradicting;    ///< and those that contradict bends or each other
  double largest_turn = 0.0;                 ///< [rad] of any window
  double given_sigma = 0.0;  ///< relative 1σ of f before: a guess, or taken for granted
  int passes = 0;
  DriveRecord drive;    ///< of the last pass
  CameraHeight height;  ///< for `estimate`

  /// Bends or another sensor confirm each other, and the focal length is surer than the guess.
  [[nodiscard]] bool knows_focal() const;
  /// Relative 1σ of the focal length of `estimate`: by the drive, else what is taken for granted of
  /// a calibration that came with the log, or what the guess is worth.
  [[nodiscard]] double focal_sigma() const;
};

/// Drives until the camera stays as it is: track with the camera of the pass before, measure the
/// windows with bends, combine them with what the guess is worth; then the height by what tells
/// metres, with one more pass where that is stereo.
/// @throws InputError as run_drive, and when no image can be read
[[nodiscard]] Calibration calibrate_camera(const CalibrateOptions& options);

}  // namespace oneac::app
