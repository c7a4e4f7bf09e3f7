#include "oneac/observations/sensor_readings.h"

#include "oneac/geometry/angles.h"
#include "oneac/geometry/vehicle_limits.h"
#include "oneac/mrpt_compat/observations.h"

#include <mrpt/math/TPoint3D.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>

#include <array>
#include <cmath>
#include <utility>

namespace oneac {
namespace {

constexpr double kMergeWithin = 0.5;             // [s] GGA and RMC of one epoch at the usual 1 Hz
constexpr double kKnot = 1852.0 / 3600.0;        // [m/s]
constexpr double kFullTurn = 2.0 * M_PI + 1e-9;  // [rad]
constexpr int kNoFix = 0;                        // GGA fix quality
// [s] between positions that give a speed: nearer ones differ by their noise, in a longer time the
// speed changes; one epoch of 1 Hz may be missing.
constexpr double kShortestStretch = 0.8, kLongestStretch = 2.5;
// [m] 1σ of a position against the one a second before: the receiver's slow errors are the same in
// both; its rounding to 1e-4 minutes of arc, 0.2 m, is not.
constexpr double kPositionNoise = 0.15;
constexpr double kDoubtSigmas = 4.0;
constexpr std::int8_t kRmcValid = 'A';

using GGA = mrpt::obs::gnss::Message_NMEA_GGA;
using RMC = mrpt::obs::gnss::Message_NMEA_RMC;
using mrpt::obs::CObservationGPS;
using mrpt::obs::CObservationIMU;
using Fields = std::array<mrpt::obs::TIMUDataIndex, 3>;

/// Turned from the sensor's axes into the vehicle's; empty beyond ±limit.
std::optional<Eigen::Vector3d> vector_of(const CObservationIMU& imu, const Fields& fields,
                                         double limit) {
  mrpt::math::TPoint3D in_sensor;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto value = compat::imu_field(imu, fields[i]);
    if (!value) return std::nullopt;
    in_sensor[i] = *value;
  }
  const mrpt::math::TPoint3D v = imu.sensorPose.rotateVector(in_sensor);
  const bool sane = std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
  if (!sane) return std::nullopt;
  return Eigen::Vector3d(v.x, v.y, v.z);
}

/// [m] over ground between two near positions.
double way_between(const GeodeticFix& a, const GeodeticFix& b) {
  constexpr double kEquator = 6378137.0, kEccentricity2 = 6.69437999014e-3;  // [m], [-] of WGS84
  const double sine = std::sin(a.latitude_deg * kDegree);
  const double w2 = 1.0 - kEccentricity2 * sine * sine;
  const double across = kEquator / std::sqrt(w2);  // radii of curvature
  const double along = across * (1.0 - kEccentricity2) / w2;
  const double turned = std::remainder(b.longitude_deg - a.longitude_deg, 360.0) * kDegree;
  return std::hypot(along * (b.latitude_deg - a.latitude_deg) * kDegree,
                    across * std::cos(a.latitude_deg * kDegree) * turned);
}

/// Of a car between two places.
template <class Place>
SpeedReading speed_between(const Place& a, const Place& b) {
  const double seconds = b.time_s - a.time_s;
  return {0.5 * (a.time_s + b.time_s), way_between(a.position, b.position) / seconds,
          std::sqrt(2.0) * kPositionNoise / seconds};
}

/// A receiver that has no fix yet writes 0, 0, a place at sea.
bool is_on_earth(const GeodeticFix& fix) {
  if (fix.latitude_deg == 0.0 && fix.longitude_deg == 0.0) return false;
  return std::abs(fix.latitude_deg) <= 90.0 && std::abs(fix.longitude_deg) <= 360.0 &&
         std::abs(fix.height) < SensorLimits::kHighest;
}

void add_motion(const RMC& rmc, GpsReading& reading) {
  if (rmc.fields.validity_char != kRmcValid) return;
  const double speed = rmc.fields.speed_knots * kKnot;
  const double course = rmc.fields.direction_degrees * kDegree;
  if (speed >= 0.0 && speed <= SensorLimits::kFastest) reading.speed = speed;
  if (std::abs(course) <= kFullTurn) reading.course = course;
}

}  // namespace

std::optional<ImuSample> imu_sample(const mrpt::obs::CObservation& observation) {
  using namespace mrpt::obs;  // the names of the fields
  const auto* imu = dynamic_cast<const CObservationIMU*>(&observation);
  if (imu == nullptr || imu->timestamp == INVALID_TIMESTAMP) return std::nullopt;
  ImuSample sample;
  sample.time_s = compat::unix_seconds(imu->timestamp);
  sample.acceleration =
      vector_of(*imu, {IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC}, SensorLimits::kAcceleration);
  sample.angular_rate = vector_of(*imu, {IMU_WX, IMU_WY, IMU_WZ}, SensorLimits::kRate);
  if (!sample.acceleration && !sample.angular_rate) return std::nullopt;
  return sample;
}

std::optional<GpsReading> gps_reading(const mrpt::obs::CObservation& observation) {
  const auto* gps = dynamic_cast<const CObservationGPS*>(&observation);
  if (gps == nullptr || gps->timestamp == INVALID_TIMESTAMP) return std::nullopt;
  GpsReading reading;
  reading.time_s = compat::unix_seconds(gps->timestamp);
  if (const auto* gga = compat::gps_message<GGA>(*gps)) {
    const GeodeticFix fix{gga->fields.latitude_degrees, gga->fields.longitude_degrees,
                          gga->fields.altitude_meters};
    if (gga->fields.fix_quality != kNoFix && is_on_earth(fix)) reading.position = fix;
  }
  if (const auto* rmc = compat::gps_message<RMC>(*gps)) add_motion(*rmc, reading);
  if (!reading.position && !reading.has_motion()) return std::nullopt;
  return reading;
}

GpsEpochs::Place GpsEpochs::add(const GpsReading& reading) {
  const bool fits = epoch_ && reading.time_s - epoch_->time_s <= kMergeWithin &&
                    !(reading.position && epoch_->position) &&
                    !(reading.has_motion() && epoch_->has_motion());
  if (!fits) {
    epoch_ = reading;
    return {reading.time_s, true};
  }
  if (reading.position) epoch_->position = reading.position;
  if (reading.speed) epoch_->speed = reading.speed;
  if (reading.course) epoch_->course = reading.course;
  return {epoch_->time_s, false};
}

std::optional<SpeedReading> SpeedOverGround::add(const GpsReading& reading) {
  const double time_s = epochs_.add(reading).time_s;
  std::optional<SpeedReading> told;
  if (reading.position) told = between_positions(time_s, *reading.position);
  if (!reading.speed) return told;
  stated_ = true;
  return SpeedReading{time_s, *reading.speed};
}

bool SpeedOverGround::is_driven(const SpeedReading& told) const {
  if (!(told.speed <= VehicleLimits::kFastest)) return false;
  if (!driven_) return true;
  const double seconds = told.time_s - driven_->time_s;
  if (seconds > 2.0 * kLongestStretch) return true;
  const double most = VehicleLimits::kHardestAcceleration * seconds +
                      kDoubtSigmas * std::hypot(told.sigma, driven_->sigma);
  return std::abs(told.speed - driven_->speed) <= most;
}

std::optional<SpeedReading> SpeedOverGround::between_positions(double time_s,
                                                               const GeodeticFix& here) {
  const Place now{time_s, here};
  if (last_ && time_s - last_->time_s < kShortestStretch) return std::nullopt;
  const bool stated = std::exchange(stated_, false);
  const auto go_on_from = [&](std::optional<SpeedReading> told) {
    last_ = now;
    doubted_.reset();
    driven_ = told;
    return stated ? std::nullopt : told;
  };
  if (!last_ || time_s - last_->time_s > kLongestStretch) return go_on_from(std::nullopt);
  const SpeedReading told = speed_between(*last_, now);
  if (is_driven(told)) return go_on_from(told);
  // Two places near each other and far from where the car was: that one was wrong.
  if (doubted_ && time_s - doubted_->time_s < kShortestStretch) return std::nullopt;
  if (doubted_) {
    const SpeedReading there = speed_between(*doubted_, now);
    if (there.speed <= VehicleLimits::kFastest) return go_on_from(there);
  }
  doubted_ = now;
  return std::nullopt;
}

}  // namespace oneac
