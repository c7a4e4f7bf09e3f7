#pragma once

#include "street_layout.h"

#include <Eigen/Core>

#include <vector>

namespace oneac::simulation {

/// A vehicle that crosses a street at a right angle and a constant speed, out of the buildings on
/// one side and into those on the other.
struct CrossingVehicle {
  Box at_start;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  double start_s = 0.0;
  double duration_s = 0.0;

  [[nodiscard]] Box at(double time_s) const;
};

/// One per street, in its second half, timed so that it passes some way before the car.
[[nodiscard]] std::vector<CrossingVehicle> crossing_traffic(const Route& route, double duration_s);

}  // namespace oneac::simulation
