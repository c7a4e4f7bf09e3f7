#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace oneac {

/// A stretch of a drive, straight at both ends, whose turn images and another sensor saw.
struct TurnSpan {
  double duration = 0.0;   ///< [s]
  double by_images = 0.0;  ///< [rad] by the camera in use, counter-clockwise
  double by_sensor = 0.0;  ///< [rad] the same turn
};

/// What is known of the errors of the other sensor.
struct TurnSensor {
  double span_sigma = 0.0;   ///< [rad] least 1σ of the difference over a span
  double scale_sigma = 0.0;  ///< [-] 1σ of its scale: no drive tells it from a focal length
  double bias_sigma = 0.0;   ///< [rad/s] 1σ of its bias before the drive; 0: it has none

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

/// What turns say of the focal length.
struct TurnMeasurement {
  double log_focal = 0.0;  ///< ln(f / f in use)
  double sigma = 0.0;      ///< 1σ of it
  double bias = 0.0;       ///< [rad/s] of the sensor
  double scatter = 0.0;    ///< [rad] 1σ of a span's difference
  double bends = 0.0;      ///< how many spans the turn is spread over: (Σψ²)² / Σψ⁴
};

/// A turn by images is as much too small as the focal length in use is too long:
/// ψ_sensor = ψ_images · f_in_use / f + bias · duration.
/// Least squares over spans with Cauchy's weights; σ is the larger of that of the residuals'
/// scatter and of the heteroscedasticity-robust one [White 1980], with the sensor's scale.
/// @return empty where not two bends and four spans confirm each other
/// @throws std::invalid_argument as TurnSensor::validate
[[nodiscard]] std::optional<TurnMeasurement> measure_focal_by_turns(
    const std::vector<TurnSpan>& spans, const TurnSensor& sensor);

}  // namespace oneac
