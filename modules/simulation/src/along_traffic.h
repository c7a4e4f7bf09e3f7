#pragma once

#include "crossing_traffic.h"

#include "oneac/simulation/simulation_options.h"

#include <vector>

namespace oneac::simulation {

/// Vehicles on the left lane of a straight route, all at one constant speed: every few seconds one
/// passes the car, or meets it.
[[nodiscard]] std::vector<MovingVehicle> overtaking_traffic(const Route& route, double duration_s);
[[nodiscard]] std::vector<MovingVehicle> oncoming_traffic(const Route& route, double duration_s);

/// A truck on the car's lane, at the gap of the options; its rear is lettered.
[[nodiscard]] std::vector<MovingVehicle> truck_ahead(const SimulationOptions& options,
                                                     const Route& route);

/// What the options ask for.
[[nodiscard]] std::vector<MovingVehicle> traffic_of(const SimulationOptions& options,
                                                    const Route& route, double duration_s);

}  // namespace oneac::simulation
