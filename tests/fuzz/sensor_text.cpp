// The GPS and IMU text files of the Málaga dataset.
#include "fuzz.h"
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
}
