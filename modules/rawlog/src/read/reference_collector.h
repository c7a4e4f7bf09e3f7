#pragma once

#include "oneac/observations/sensor_readings.h"
#include "oneac/rawlog/vehicle_reference.h"

#include <mrpt/obs/CObservation.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// Gathers the GPS and IMU observations of a log and turns them into a reference.
///
/// Sensors are kept apart by label; the reference takes the GPS with the most epochs and the IMU
/// with the most samples (the alphabetically first of equals). Void fixes and numbers that no
/// vehicle on earth can have are dropped, as are observations without a time stamp.
class ReferenceCollector {
 public:
  /// Takes what is a CObservationGPS or CObservationIMU, ignores the rest.
  void add(const mrpt::obs::CObservation& observation);
  /// What was gathered so far: GGA and RMC within half a second merged, in time order.
  [[nodiscard]] VehicleReference build() const;

 private:
  using Readings = std::vector<GpsReading>;

  [[nodiscard]] static Readings merged(Readings readings);
  [[nodiscard]] static std::vector<SpeedReading> speeds_of(Readings readings);
  [[nodiscard]] static std::vector<GpsFix> to_fixes(const Readings& epochs);
  [[nodiscard]] static std::optional<GeodeticFix> first_position(const Readings& epochs);

  std::map<std::string, Readings> gps_;
  std::map<std::string, std::vector<ImuSample>> imu_;
};

}  // namespace oneac
