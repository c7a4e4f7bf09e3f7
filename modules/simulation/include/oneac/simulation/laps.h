#pragma once

#include "oneac/simulation/street_simulator.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace oneac {

/// How many frames it takes to drive so many laps of the block; what the options say of frames
/// does not matter.
/// @throws std::invalid_argument naming field, value and bound; route must have laps
[[nodiscard]] int frames_for_laps(const SimulationOptions& options, int laps);

/// Two frames of one place, the truth of a loop.
struct TrueLoop {
  std::size_t index1 = 0;  ///< the earlier one
  std::size_t index2 = 0;
  Eigen::Isometry3d T_2_1 = Eigen::Isometry3d::Identity();  ///< X2 = T X1, camera frames [m]
};

/// For every frame whose camera stands within 3 m and 15 degrees of where that of an earlier frame
/// stood, more than 30 m of driving ago: the nearest of these. In the order of index2.
[[nodiscard]] std::vector<TrueLoop> true_loops(const StreetSimulator& simulator);

}  // namespace oneac
