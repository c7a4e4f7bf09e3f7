// The GPS and IMU text files of the Málaga dataset; NMEA, CSV and GPX beside a video.
#include "fuzz.h"
#include "import/gps_text.h"
#include "import/malaga_text.h"

#include "oneac/base/error.h"

#include <cmath>

ONEAC_FUZZ_TARGET(sensor_text) {
  using namespace oneac;
  const auto file = fuzz::file_with(data);
  try {
    for (const GpsRecord& gps : read_malaga_gps(file)) {
      fuzz::check(std::isfinite(gps.position.latitude_deg + gps.time_s), "finite fixes");
    }
  } catch (const InputError&) {  // what it may throw
  }
  try {
    for (const ImuRecord& imu : read_malaga_imu(file)) {
      fuzz::check(imu.acceleration.allFinite() && imu.angular_rate.allFinite(), "finite samples");
    }
  } catch (const InputError&) {  // what it may throw
  }
  for (const auto read : {read_nmea, read_gps_csv, read_gpx}) {
    try {
      ImportReport report;
      double last = -1.0;
      for (const GpsRecord& gps : read(file, report)) {
        const GeodeticPosition& p = gps.position;
        fuzz::check(std::isfinite(p.latitude_deg + p.longitude_deg + p.altitude_m), "finite fixes");
        fuzz::check(gps.time_s > last && gps.time_s < 5e9, "times that increase");
        last = gps.time_s;
      }
    } catch (const InputError&) {  // what it may throw
    }
  }
}
