#pragma once

#include "measurements.h"

#include "oneac/observations/sensor_readings.h"

#include <deque>
#include <optional>

namespace oneac {

/// Measures the map's scale by speeds over ground: the way between two fixes, by the trapezium
/// rule, against the length that the map gives it. Each interval counts once, so the errors of
/// successive measurements are nearly independent.
class SpeedScale {
 public:
  /// Speeds in time order; they may lie ahead of the images (offline) or behind (a live receiver).
  void add_speed(const SpeedReading& told);
  /// The camera was `length` farther at `time_s`.
  void add_step(double time_s, double length);
  /// What came before is not connected with what follows.
  void restart(double time_s);
  /// Multiplies the lengths so far.
  void rescale(double factor);
  /// Since the last call: the way between fixes that both lie within the steps.
  [[nodiscard]] std::optional<ScaleMeasurement> measure();
  /// A first guess before there are two fixes: the speed at a moment within the steps, against
  /// the map's speed around it.
  [[nodiscard]] std::optional<ScaleMeasurement> first_guess() const;

 private:
  struct Sample {
    double time_s;
    double value;  ///< length from the start [map]
  };
  struct Speed {
    double value;  ///< [m/s]
    double sigma;
  };
  [[nodiscard]] double length_at(double time_s) const;
  [[nodiscard]] std::optional<Speed> speed_at(double time_s) const;

  std::deque<SpeedReading> speeds_;
  std::deque<Sample> way_;
};

}  // namespace oneac
