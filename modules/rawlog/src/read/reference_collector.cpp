#include "read/reference_collector.h"

#include "read/log_reader.h"

#include <mrpt/topography/conversions.h>

#include <algorithm>
#include <utility>

namespace oneac {
namespace {

// The longest list of all labels; the alphabetically first of equals.
template <class T>
const std::pair<const std::string, std::vector<T>>* longest(
    const std::map<std::string, std::vector<T>>& lists) {
  const std::pair<const std::string, std::vector<T>>* best = nullptr;
  for (const auto& entry : lists) {
    if (best == nullptr || entry.second.size() > best->second.size()) best = &entry;
  }
  return best;
}

template <class T>
void sort_by_time(std::vector<T>& list) {
  std::stable_sort(list.begin(), list.end(),
                   [](const T& a, const T& b) { return a.time_s < b.time_s; });
}

}  // namespace

void ReferenceCollector::add(const mrpt::obs::CObservation& observation) {
  if (const auto sample = imu_sample(observation)) {
    imu_[observation.sensorLabel].push_back(*sample);
  } else if (const auto reading = gps_reading(observation)) {
    gps_[observation.sensorLabel].push_back(*reading);
  }
}

ReferenceCollector::Readings ReferenceCollector::merged(Readings readings) {
  sort_by_time(readings);
  Readings epochs;
  GpsEpochs joined;
  for (const auto& reading : readings) {
    if (joined.add(reading).begins) {
      epochs.push_back(reading);
      continue;
    }
    if (reading.position) epochs.back().position = reading.position;
    if (reading.speed) epochs.back().speed = reading.speed;
    if (reading.course) epochs.back().course = reading.course;
  }
  return epochs;
}

std::vector<SpeedReading> ReferenceCollector::speeds_of(Readings readings) {
  sort_by_time(readings);
  SpeedOverGround over_ground;
  std::vector<SpeedReading> speeds;
  for (const auto& reading : readings) {
    if (const auto speed = over_ground.add(reading)) speeds.push_back(*speed);
  }
  sort_by_time(speeds);
  return speeds;
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

std::optional<GeodeticFix> ReferenceCollector::first_position(const Readings& epochs) {
  for (const auto& epoch : epochs) {
    if (epoch.position) return epoch.position;
  }
  return std::nullopt;
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
  if (const auto* best = longest(epochs)) {
    reference.gps = to_fixes(best->second);
    reference.origin = first_position(best->second);
    reference.speeds = speeds_of(gps_.at(best->first));
  }
  if (const auto* best = longest(imu_)) reference.imu = best->second;
  sort_by_time(reference.imu);
  return reference;
}

}  // namespace oneac
