#pragma once

#include "oneac/observations/sensor_readings.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace mrpt::obs {
class CObservation;
}

namespace oneac {

/// What wheels say at a moment.
struct WheelReading {
  double time_s = 0.0;                                 ///< Unix time [s]
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< as they add up their way [m]
  std::optional<double> speed;                         ///< of the vehicle's origin, ≥ 0 [m/s]
};

/// The reading of a CObservationOdometry; empty for any other, without time stamp, and when what
/// it states is not finite or beyond SensorLimits.
[[nodiscard]] std::optional<WheelReading> wheel_reading(const mrpt::obs::CObservation& observation);

/// Speeds out of the readings of one odometer, as the way over stretches of about a quarter of a
/// second: of the speeds where it states them, else between its positions.
///
/// Stretches count when a vehicle can get from the speed of each to that of the next, for a second
/// on end: a counter that jumps or is set back, once or again and again, tells speeds that do not
/// follow each other. A stated speed that stays the same bit by bit for longer than a second is
/// that of a sensor that froze, and none until it changes. A speed is known a stretch later than it
/// was driven.
class WheelSpeeds {
 public:
  /// 1σ of a stretch [-]: driven and braked tyres slip by 1 to 3 %, and the camera swings out
  /// beside the axle in bends. What all stretches share is ScaleOptions::wheel_uncertainty.
  static constexpr double kSlip = 0.02;

  /// @param reading  in order of time; one that is not later than the last is not used
  /// @return the speed in the middle of a stretch that is over, with its 1σ
  [[nodiscard]] std::optional<SpeedReading> add(const WheelReading& reading);

 private:
  [[nodiscard]] bool is_frozen(const WheelReading& reading);
  void begin(double time_s);
  [[nodiscard]] std::optional<SpeedReading> confirmed(const SpeedReading& newest);

  std::optional<WheelReading> last_;
  double begin_s_ = 0.0;                 ///< of the stretch
  double way_ = 0.0;                     ///< [m] since then
  double unchanged_since_s_ = 0.0;       ///< the stated speed
  std::optional<SpeedReading> waiting_;  ///< the last stretch
  int steady_ = 0;                       ///< stretches in a row that follow each other
};

/// Follows one odometer among observations: the first whose reading can be used.
class WheelFollower {
 public:
  /// What became of an observation.
  enum class Use { kTaken, kOtherSensor, kUnusable };
  struct Taken {
    Use use = Use::kUnusable;
    std::optional<SpeedReading> speed;  ///< when a stretch is over
  };
  /// @param observation  a CObservationOdometry with a time stamp
  [[nodiscard]] Taken take(const mrpt::obs::CObservation& observation);

 private:
  std::optional<std::string> label_;
  WheelSpeeds speeds_;
};

}  // namespace oneac
