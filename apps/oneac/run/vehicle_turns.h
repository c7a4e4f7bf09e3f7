#pragma once

#include "oneac/calibration/turn_spans.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/observations/sensor_readings.h"

#include <cstddef>
#include <vector>

namespace oneac::app {

/// [rad] about its upright from the pose before to this one; 0 for the first.
[[nodiscard]] double turn_about_upright(const Trajectory& vehicle, std::size_t i);

/// By one axis of the log's gyroscope, 0 to 2; the vehicle's upright is 2.
[[nodiscard]] GyroscopeHeading heading_by_gyroscope(const std::vector<ImuSample>& samples,
                                                    int axis = 2);

}  // namespace oneac::app
