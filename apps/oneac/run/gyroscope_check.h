#pragma once

#include "oneac/evaluation/trajectory_io.h"
#include "oneac/observations/sensor_readings.h"

#include <optional>
#include <string>
#include <vector>

namespace oneac::app {

/// How a gyroscope that does not turn with the images does turn.
struct GyroscopeFault {
  int axis = -1;  ///< of the sensor, 0 to 2, whose turns are those of the images; −1: of none
  double times = 1.0;  ///< as much as the images, negative the other way round
};

/// Turns about the vehicle's upright by images and about the three axes of the gyroscope, over
/// windows of two seconds, its bias left out. Empty where its Z axis turns as the images do, to a
/// factor of two, or no bend tells.
/// @param vehicle  poses of the vehicle (X forward, Z up) with times
/// @param carried  per pose, whether the images told the step to it
[[nodiscard]] std::optional<GyroscopeFault> fault_of_gyroscope(const Trajectory& vehicle,
                                                               const std::vector<bool>& carried,
                                                               const std::vector<ImuSample>& imu);

/// The line that tells it, with the cure.
[[nodiscard]] std::string about_gyroscope(const GyroscopeFault& fault);

}  // namespace oneac::app
