#pragma once

#include "oneac/rawlog/sensor_records.h"

#include <mrpt/obs/CObservationGPS.h>

namespace oneac {

/// The position of a record as an observation with one GGA message.
[[nodiscard]] mrpt::obs::CObservationGPS gga_observation(const GpsRecord& record);

/// Position, speed and course of a record as an observation with one RMC message.
/// @pre record.velocity has a value
[[nodiscard]] mrpt::obs::CObservationGPS rmc_observation(const GpsRecord& record);

}  // namespace oneac
