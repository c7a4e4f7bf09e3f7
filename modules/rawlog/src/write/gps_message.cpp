#include "write/gps_message.h"

#include "write/mrpt_time.h"

#include <mrpt/topography/conversions.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace oneac {
namespace {

using mrpt::obs::CObservationGPS;
using mrpt::obs::gnss::Message_NMEA_GGA;
using mrpt::obs::gnss::Message_NMEA_RMC;
using mrpt::obs::gnss::UTC_time;

constexpr double kDay = 86400.0;           // [s]
constexpr double kHour = 3600.0;           // [s]
constexpr double kMinute = 60.0;           // [s]
constexpr double kKnot = 1852.0 / 3600.0;  // [m/s]

UTC_time time_of_day(double time_s) {
  const double seconds = time_s - std::floor(time_s / kDay) * kDay;
  UTC_time time;
  time.hour = static_cast<std::uint8_t>(seconds / kHour);
  time.minute = static_cast<std::uint8_t>((seconds - time.hour * kHour) / kMinute);
  time.sec = seconds - time.hour * kHour - time.minute * kMinute;
  return time;
}

struct Date {
  int day;
  int month;
  int year;
};

/// Gregorian date of a day counted from 1 January 1970 (Richards' algorithm over a shifted year).
Date date_of(double time_s) {
  const long julian = static_cast<long>(std::floor(time_s / kDay)) + 2440588;
  const long f = julian + 1401 + (4 * julian + 274277) / 146097 * 3 / 4 - 38;
  const long e = 4 * f + 3;
  const long h = 5 * (e % 1461 / 4) + 2;
  const long month = (h / 153 + 2) % 12 + 1;
  const long year = e / 1461 - 4716 + (12 + 2 - month) / 12;
  return {static_cast<int>(h % 153 / 5 + 1), static_cast<int>(month), static_cast<int>(year)};
}

CObservationGPS empty_observation(const GpsRecord& record) {
  CObservationGPS observation;
  observation.sensorLabel = record.label;
  observation.timestamp = mrpt_time(record.time_s);
  observation.originalReceivedTimestamp = observation.timestamp;
  observation.has_satellite_timestamp = true;
  observation.sensorPose.x(record.antenna.x());
  observation.sensorPose.y(record.antenna.y());
  observation.sensorPose.z(record.antenna.z());
  return observation;
}

}  // namespace

CObservationGPS gga_observation(const GpsRecord& record) {
  Message_NMEA_GGA message;
  message.fields.UTCTime = time_of_day(record.time_s);
  message.fields.latitude_degrees = record.position.latitude_deg;
  message.fields.longitude_degrees = record.position.longitude_deg;
  message.fields.altitude_meters = record.position.altitude_m;
  message.fields.fix_quality = static_cast<std::uint8_t>(record.fix_quality);
  message.fields.satellitesUsed = static_cast<std::uint32_t>(std::max(record.satellites, 0));
  CObservationGPS observation = empty_observation(record);
  observation.setMsg(message);
  return observation;
}

CObservationGPS rmc_observation(const GpsRecord& record) {
  const GroundVelocity& velocity = record.velocity.value();
  const Date date = date_of(record.time_s);
  Message_NMEA_RMC message;
  message.fields.UTCTime = time_of_day(record.time_s);
  message.fields.validity_char = record.fix_quality > 0 ? 'A' : 'V';
  message.fields.latitude_degrees = record.position.latitude_deg;
  message.fields.longitude_degrees = record.position.longitude_deg;
  message.fields.speed_knots = velocity.speed_mps / kKnot;
  message.fields.direction_degrees = velocity.course_deg;
  message.fields.date_day = static_cast<std::uint8_t>(date.day);
  message.fields.date_month = static_cast<std::uint8_t>(date.month);
  message.fields.date_year = static_cast<std::uint8_t>(date.year % 100);
  message.fields.positioning_mode = record.fix_quality > 0 ? 'A' : 'N';
  CObservationGPS observation = empty_observation(record);
  observation.setMsg(message);
  return observation;
}

// MRPT's own ENUToGeocentric() (2.5.8) is off by a thousandth of the distance.
GeodeticPosition geodetic_from_enu(const Eigen::Vector3d& enu, const GeodeticPosition& origin) {
  const double latitude = origin.latitude_deg * M_PI / 180.0;
  const double longitude = origin.longitude_deg * M_PI / 180.0;
  const Eigen::Matrix3d R_earth_enu =
      (Eigen::AngleAxisd(longitude + M_PI / 2, Eigen::Vector3d::UnitZ()) *
       Eigen::AngleAxisd(M_PI / 2 - latitude, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  mrpt::math::TPoint3D centre;
  mrpt::topography::geodeticToGeocentric_WGS84(
      {origin.latitude_deg, origin.longitude_deg, origin.altitude_m}, centre);
  const Eigen::Vector3d X = Eigen::Vector3d(centre.x, centre.y, centre.z) + R_earth_enu * enu;
  mrpt::topography::TGeodeticCoords geodetic;
  mrpt::topography::geocentricToGeodetic({X.x(), X.y(), X.z()}, geodetic);
  return {geodetic.lat.decimal_value, geodetic.lon.decimal_value, geodetic.height};
}

}  // namespace oneac
