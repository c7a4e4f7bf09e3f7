#pragma once

#include "oneac/simulation/simulation_options.h"

#include <string>
#include <vector>

namespace oneac {

/// A kind of drive on which visual odometry goes wrong on real roads.
struct HardDrive {
  std::string name;  ///< as `oneac simulate --hard` takes it
  std::string what;  ///< what is hard about it, in some words
  SimulationOptions options;
};

/// Every kind, in the order of docs/benchmarks/hard-drives.md.
[[nodiscard]] const std::vector<HardDrive>& hard_drives();

/// The kind of a name.
/// @throws std::invalid_argument naming the kinds there are
[[nodiscard]] const HardDrive& hard_drive(const std::string& name);

}  // namespace oneac
