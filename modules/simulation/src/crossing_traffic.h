#pragma once

#include "street_layout.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace oneac::simulation {

/// A block that moves without turning.
struct MovingVehicle {
  Box at_start;
  std::function<Eigen::Vector3d(double time_s)> shift;  ///< from where it starts [m]

  [[nodiscard]] Box at(double time_s) const;
};

/// Vehicles that cross a street at a right angle and a constant speed, out of the buildings on one
/// side and into those on the other: one per street, in its second half, timed so that it passes
/// some way before the car.
[[nodiscard]] std::vector<MovingVehicle> crossing_traffic(const Route& route, double duration_s);
/// Buses that cross before the camera during every stop, so near that they fill the picture.
[[nodiscard]] std::vector<MovingVehicle> crossing_buses(const Route& route);

}  // namespace oneac::simulation
