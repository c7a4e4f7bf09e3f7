#include "reference_collector.h"

#include "log_reader.h"

#include "oneac/geometry/angles.h"
#include "oneac/mrpt_compat/observations.h"

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/topography/conversions.h>

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

constexpr double kMergeWithin = 0.5;       // [s] GGA and RMC of one epoch at the usual 1 Hz
constexpr double kKnot = 1852.0 / 3600.0;  // [m/s]
// What a damaged reading exceeds; the comparisons are false for NaN.
constexpr double kFastest = 1e3;                 // [m/s]
constexpr double kFullTurn = 2.0 * M_PI + 1e-9;  // [rad]
constexpr double kHighest = 1e5;                 // [m] above the ellipsoid, either way
constexpr int kNoFix = 0;                        // GGA fix quality
constexpr std::int8_t kRmcValid = 'A';

using GGA = mrpt::obs::gnss::Message_NMEA_GGA;
using RMC = mrpt::obs::gnss::Message_NMEA_RMC;
using mrpt::obs::CObservationGPS;
using mrpt::obs::CObservationIMU;

/// Turned from the sensor's axes into the vehicle's.
std::optional<Eigen::Vector3d> vector_of(const CObservationIMU& imu,
                                         const std::array<mrpt::obs::TIMUDataIndex, 3>& fields) {
  mrpt::math::TPoint3D in_sensor;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto value = compat::imu_field(imu, fields[i]);
    if (!value) return std::nullopt;
    in_sensor[i] = *value;
  }
  const mrpt::math::TPoint3D v = imu.sensorPose.rotateVector(in_sensor);
  if (!std::isfinite(v.x + v.y + v.z)) return std::nullopt;
  return Eigen::Vector3d(v.x, v.y, v.z);
}

std::optional<ImuSample> sample_of(const CObservationIMU& imu) {
  using namespace mrpt::obs;  // the names of the fields
  ImuSample sample;
  sample.time_s = compat::unix_seconds(imu.timestamp);
  sample.acceleration = vector_of(imu, {IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC});
  sample.angular_rate = vector_of(imu, {IMU_WX, IMU_WY, IMU_WZ});
  if (!sample.acceleration && !sample.angular_rate) return std::nullopt;
  return sample;
}

// The longest list of all labels; the alphabetically first of equals.
template <class T>
const std::vector<T>* longest(const std::map<std::string, std::vector<T>>& lists) {
  const std::vector<T>* best = nullptr;
  for (const auto& [label, list] : lists) {
    if (best == nullptr || list.size() > best->size()) best = &list;
  }
  return best;
}

template <class T>
void sort_by_time(std::vector<T>& list) {
  std::stable_sort(list.begin(), list.end(),
                   [](const T& a, const T& b) { return a.time_s < b.time_s; });
}

}  // namespace

bool ReferenceCollector::Geodetic::is_on_earth() const {
  return std::abs(latitude_deg) <= 90.0 && std::abs(longitude_deg) <= 360.0 &&
         std::abs(height) < kHighest;
}

void ReferenceCollector::add(const mrpt::obs::CObservation& observation) {
  if (observation.timestamp == INVALID_TIMESTAMP) return;
  if (const auto* imu = dynamic_cast<const CObservationIMU*>(&observation)) {
    if (const auto sample = sample_of(*imu)) imu_[imu->sensorLabel].push_back(*sample);
    return;
  }
  const auto* gps = dynamic_cast<const CObservationGPS*>(&observation);
  if (gps == nullptr) return;
  Reading reading;
  reading.time_s = compat::unix_seconds(gps->timestamp);
  if (const auto* gga = compat::gps_message<GGA>(*gps)) {
    const Geodetic g{gga->fields.latitude_degrees, gga->fields.longitude_degrees,
                     gga->fields.altitude_meters};
    if (gga->fields.fix_quality != kNoFix && g.is_on_earth()) reading.position = g;
  }
  if (const auto* rmc = compat::gps_message<RMC>(*gps)) {
    const bool valid = rmc->fields.validity_char == kRmcValid;
    const double speed = rmc->fields.speed_knots * kKnot;
    const double course = rmc->fields.direction_degrees * kDegree;
    if (valid && std::abs(speed) < kFastest) reading.speed = speed;
    if (valid && std::abs(course) <= kFullTurn) reading.course = course;
  }
  if (reading.position || reading.speed || reading.course) {
    gps_[gps->sensorLabel].push_back(reading);
  }
}

ReferenceCollector::Readings ReferenceCollector::merged(Readings readings) {
  sort_by_time(readings);
  Readings epochs;
  for (const auto& reading : readings) {
    const bool motion = reading.speed || reading.course;
    const bool fits = !epochs.empty() && reading.time_s - epochs.back().time_s <= kMergeWithin &&
                      !(reading.position && epochs.back().position) &&
                      !(motion && (epochs.back().speed || epochs.back().course));
    if (!fits) {
      epochs.push_back(reading);
      continue;
    }
    if (reading.position) epochs.back().position = reading.position;
    if (reading.speed) epochs.back().speed = reading.speed;
    if (reading.course) epochs.back().course = reading.course;
  }
  return epochs;
}

std::vector<GpsFix> ReferenceCollector::to_fixes(const Readings& epochs) {
  std::vector<GpsFix> fixes;
  std::optional<mrpt::topography::TGeodeticCoords> origin;
  for (const auto& epoch : epochs) {
    GpsFix fix{epoch.time_s, std::nullopt, epoch.speed, epoch.course};
    if (epoch.position) {
      const auto& p = *epoch.position;
      const mrpt::topography::TGeodeticCoords here(p.latitude_deg, p.longitude_deg, p.height);
      if (!origin) origin = here;
      mrpt::math::TPoint3D enu;
      mrpt::topography::geodeticToENU_WGS84(here, enu, *origin);
      fix.position_enu = Eigen::Vector3d(enu.x, enu.y, enu.z);
    }
    fixes.push_back(fix);
  }
  return fixes;
}

VehicleReference read_vehicle_reference(const std::filesystem::path& log) {
  LogReader reader(log);
  ReferenceCollector collector;
  while (const auto record = reader.next()) collector.add(*record->observation);
  return collector.build();
}

VehicleReference ReferenceCollector::build() const {
  VehicleReference reference;
  std::map<std::string, Readings> epochs;
  for (const auto& [label, readings] : gps_) epochs[label] = merged(readings);
  if (const auto* best = longest(epochs)) reference.gps = to_fixes(*best);
  if (const auto* best = longest(imu_)) reference.imu = *best;
  sort_by_time(reference.imu);
  return reference;
}

}  // namespace oneac
