#pragma once

#include "oneac/simulation/simulation_options.h"

#include <CLI/CLI.hpp>

#include <string>

namespace oneac::app {

/// The flags of a simulated drive. `--hard KIND` takes effect first, wherever it stands; every
/// other flag changes what it has set.
void add_simulation_flags(CLI::App& verb, SimulationOptions& options);

/// What SimulationOptions::validate() says, with the flag that was typed for the field.
[[nodiscard]] std::string in_words_of_flags(const std::string& fault);

}  // namespace oneac::app
