#pragma once

#include "oneac/evaluation/trajectory_io.h"
#include "oneac/rawlog/vehicle_reference.h"

#include <optional>
#include <string>

namespace oneac::app {

/// [s] by which the stamps of the GPS come behind those of the images, by the turns that both saw:
/// the shift, within half a minute, at which the GPS course changes as the vehicle's heading does.
/// Empty where no bend tells, and where the stamps agree to a quarter of a second or fit no better
/// with a shift.
/// @param vehicle  poses of the vehicle (X forward, Z up) with times
[[nodiscard]] std::optional<double> lag_of_gps(const Trajectory& vehicle,
                                               const VehicleReference& reference);

/// The line that tells it, with the cure.
[[nodiscard]] std::string about_lag(double lag_s);

}  // namespace oneac::app
