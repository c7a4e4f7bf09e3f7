#pragma once

#include "oneac/simulation/simulation_options.h"

#include <CLI/CLI.hpp>

namespace oneac::app {

/// The flags of a simulated drive. `--hard KIND` takes effect first, wherever it stands; every
/// other flag changes what it has set.
void add_simulation_flags(CLI::App& verb, SimulationOptions& options);

}  // namespace oneac::app
