#include "oneac/observations/wheel_readings.h"

#include "oneac/mrpt_compat/observations.h"

#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace oneac {
namespace {

constexpr double kStretch = 0.25;    // [s] wheels turn half a round in it at walking pace
constexpr double kRounding = 1e-3;   // [s] of stamps: a stretch of 0.2499 s is over
constexpr double kLongestGap = 1.0;  // [s] between readings of one stretch; usual are 10 to 100 Hz
constexpr double kFrozen = 1.0;      // [s] speeds of a moving car change within it
constexpr double kTyres = 12.0;      // [m/s²] no tyre on a road gives more, as max_acceleration
constexpr int kSteady = 4;           // stretches one after the other that fit
constexpr double kGate = 3.0;        // [σ] of a difference of speeds
// [m] 1σ of a way's end: a tooth of 48 on 1.9 m of circumference, evenly spread.
constexpr double kTooth = 1.9 / 48.0 / 3.4641016151377544;

bool is_within(double value, double limit) {
  return std::abs(value) <= limit;  // false for NaN
}

SpeedReading speed_of(double begin_s, double end_s, double way) {
  const double seconds = end_s - begin_s;
  const double speed = way / seconds;
  const double sigma = std::hypot(std::sqrt(2.0) * kTooth / seconds, WheelSpeeds::kSlip * speed);
  return {0.5 * (begin_s + end_s), speed, sigma};
}

bool can_follow(const SpeedReading& a, const SpeedReading& b) {
  const double reach = kTyres * (b.time_s - a.time_s) + kGate * std::hypot(a.sigma, b.sigma);
  return std::abs(b.speed - a.speed) <= reach;
}

/// [m] from one reading to the next.
double way_between(const WheelReading& a, const WheelReading& b) {
  if (a.speed && b.speed) return 0.5 * (*a.speed + *b.speed) * (b.time_s - a.time_s);
  return (b.position - a.position).norm();
}

}  // namespace

std::optional<WheelReading> wheel_reading(const mrpt::obs::CObservation& observation) {
  const auto* wheels = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation);
  if (wheels == nullptr || wheels->timestamp == INVALID_TIMESTAMP) return std::nullopt;
  constexpr double kFarthest = 1e8;  // [m] twice round the earth: the way of a car's life
  WheelReading reading;
  reading.time_s = compat::unix_seconds(wheels->timestamp);
  reading.position = {wheels->odometry.x(), wheels->odometry.y()};
  const auto& at = reading.position;
  if (!is_within(at.x(), kFarthest) || !is_within(at.y(), kFarthest)) return std::nullopt;
  if (!wheels->hasVelocities) return reading;
  reading.speed = std::hypot(wheels->velocityLocal.vx, wheels->velocityLocal.vy);
  if (!is_within(*reading.speed, SensorLimits::kFastest)) return std::nullopt;
  return reading;
}

void WheelSpeeds::begin(double time_s) {
  begin_s_ = time_s;
  way_ = 0.0;
}

bool WheelSpeeds::is_frozen(const WheelReading& reading) {
  const bool same = last_ && reading.speed && last_->speed == reading.speed && *reading.speed > 0.0;
  if (!same) unchanged_since_s_ = reading.time_s;
  return reading.time_s - unchanged_since_s_ > kFrozen;
}

std::optional<SpeedReading> WheelSpeeds::add(const WheelReading& reading) {
  const bool later = !last_ || reading.time_s > last_->time_s;
  if (!later) return std::nullopt;
  const bool frozen = is_frozen(reading);
  const auto last = std::exchange(last_, reading);
  if (!last || frozen || reading.time_s - last->time_s > kLongestGap) {
    waiting_ = std::nullopt;
    steady_ = 0;
    begin(reading.time_s);
    return std::nullopt;
  }
  way_ += way_between(*last, reading);
  if (reading.time_s - begin_s_ < kStretch - kRounding) return std::nullopt;
  const SpeedReading newest = speed_of(begin_s_, reading.time_s, way_);
  begin(reading.time_s);
  return confirmed(newest);
}

std::optional<SpeedReading> WheelSpeeds::confirmed(const SpeedReading& newest) {
  const auto middle = std::exchange(waiting_, newest);
  const bool sound = newest.speed <= SensorLimits::kFastest;
  if (!middle || !sound || !can_follow(*middle, newest)) {
    steady_ = 0;
    return std::nullopt;
  }
  return ++steady_ >= kSteady ? middle : std::nullopt;
}

WheelFollower::Taken WheelFollower::take(const mrpt::obs::CObservation& observation) {
  if (label_ && *label_ != observation.sensorLabel) return {Use::kOtherSensor, std::nullopt};
  const auto reading = wheel_reading(observation);
  if (!reading) return {Use::kUnusable, std::nullopt};
  label_ = observation.sensorLabel;
  return {Use::kTaken, speeds_.add(*reading)};
}

}  // namespace oneac
