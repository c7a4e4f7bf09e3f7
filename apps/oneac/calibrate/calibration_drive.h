#pragma once

#include "calibrate/turn_reference.h"
#include "run/drive_record.h"
#include "run/run_options.h"

#include "oneac/calibration/intrinsics_belief.h"

#include <optional>
#include <vector>

namespace oneac::app {

/// How to calibrate.
struct CalibrateOptions {
  RunOptions run;
  std::string output;             ///< camera.ini
  std::optional<double> fov_deg;  ///< horizontal field of view that somebody guesses
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
  double largest_turn = 0.0;                 ///< [rad] of any window
  int passes = 0;
  DriveRecord drive;  ///< of the last pass

  /// Bends or another sensor confirm each other, and the focal length is surer than the guess.
  [[nodiscard]] bool knows_focal() const;
};

/// Drives until the camera stays as it is: track with the camera of the pass before, measure the
/// windows with bends, combine them with what the guess is worth.
/// @throws InputError as run_drive, and when no image can be read
[[nodiscard]] Calibration calibrate_camera(const CalibrateOptions& options);

}  // namespace oneac::app
