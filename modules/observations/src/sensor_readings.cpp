#include "oneac/observations/sensor_readings.h"

#include "oneac/geometry/angles.h"
#include "oneac/mrpt_compat/observations.h"

#include <mrpt/math/TPoint3D.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>

#include <array>
#include <cmath>

namespace oneac {
namespace {

constexpr double kMergeWithin = 0.5;             // [s] GGA and RMC of one epoch at the usual 1 Hz
constexpr double kKnot = 1852.0 / 3600.0;        // [m/s]
constexpr double kFullTurn = 2.0 * M_PI + 1e-9;  // [rad]
constexpr int kNoFix = 0;                        // GGA fix quality
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

bool is_on_earth(const GeodeticFix& fix) {
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

}  // namespace oneac
