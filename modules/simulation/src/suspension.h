#pragma once

#include "route.h"

#include "oneac/simulation/simulation_options.h"

#include <vector>

namespace oneac::simulation {

/// Rotation of the vehicle's body against the road.
struct BodyAttitude {
  double pitch = 0.0;       ///< about Y: positive nose down [rad]
  double roll = 0.0;        ///< about X: positive right side down [rad]
  double pitch_rate = 0.0;  ///< [rad/s]
  double roll_rate = 0.0;   ///< [rad/s]
};

/// The body as a damped oscillator in pitch and in roll, driven by the road's roughness (which
/// grows with speed and is none when standing) and by the forces of braking and cornering.
class Suspension {
 public:
  Suspension(const SimulationOptions& options, const Route& route, double duration_s);
  [[nodiscard]] BodyAttitude at(double time_s) const;

 private:
  std::vector<BodyAttitude> table_;
};

}  // namespace oneac::simulation
