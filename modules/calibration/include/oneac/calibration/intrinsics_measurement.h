#pragma once

#include "oneac/calibration/calibration_window.h"
#include "oneac/calibration/intrinsics.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace oneac {

/// What is known of a camera before a drive, as 1σ of IntrinsicsVector.
struct IntrinsicsPrior {
  double focal = 0.03;   ///< [-] relative: lenses calibrated years ago, images resized since
  double centre = 0.02;  ///< [-] of the focal length: 10 px of 500
  double k1 = 0.1;       ///< [-] a usual lens of 60 to 90°
  double k2 = 0.1;       ///< [-]

  [[nodiscard]] IntrinsicsMatrix information() const;
  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

struct MeasurementOptions {
  double point_noise_px =
      0.3;  ///< [px] 1σ of a sighting, at first; then what residuals say, at least ...
  double least_noise_px = 0.05;  ///< [px] ... this: what no tracker is better than
  double loss_sigmas = 2.0;      ///< [σ] scale of the Cauchy loss
  int max_iterations = 30;
  std::size_t most_tracks = 400;  ///< the longest ones
};

/// What one window says of the camera, in the neighbourhood of `at`.
struct IntrinsicsMeasurement {
  IntrinsicsVector change;       ///< most probable one against `from`, with the prior
  IntrinsicsMatrix information;  ///< of the window alone: poses and landmarks marginalised
  IntrinsicsVector pull;         ///< information · (best change of the window alone)
  double residual_px = 0.0;      ///< robust 1σ of a coordinate after the fit
  std::size_t tracks = 0, sightings = 0;
  double turn = 0.0;  ///< [rad]
};

/// Bundle adjustment of a window with the camera as an unknown: every sighting of every track of at
/// least three views, each landmark with one depth, Cauchy loss; the first view and the length of
/// the way hold the gauge, the prior holds what the window cannot tell.
/// @param from   what the change is counted from, and the prior's mean
/// @param start  where the iteration starts
/// @return empty where there are too few tracks, or nothing was found
/// @throws std::invalid_argument on a camera or prior out of bounds
[[nodiscard]] std::optional<IntrinsicsMeasurement> measure_intrinsics(
    const CalibrationWindow& window, const PinholeCamera& from, const IntrinsicsVector& start,
    const IntrinsicsPrior& prior, const MeasurementOptions& options);

/// A sighting and how far its landmark is from it in the image.
struct SightingResidual {
  Eigen::Vector2d u;      ///< [px]
  double residual = 0.0;  ///< [px]
};

/// The sightings of a window after the best fit that this camera allows; empty as above.
[[nodiscard]] std::vector<SightingResidual> residuals_with(const CalibrationWindow& window,
                                                           const PinholeCamera& camera,
                                                           const MeasurementOptions& options);

}  // namespace oneac
