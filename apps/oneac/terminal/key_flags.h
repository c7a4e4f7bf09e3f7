#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace oneac::app {

/// A flag that is also a key: it is kept as a setting "key=value" and applied after the files.
void add_key(CLI::App& verb, const std::string& flag, const std::string& key,
             std::vector<std::string>& settings, const std::string& help);

/// The flags that choose images and correspondences, the same for every verb that reads a drive.
void add_selection(CLI::App& verb, std::vector<std::string>& settings);

/// Checks of a flag: a finite number above 0, or of at least 0. CLI11's own name the largest double
/// in 309 digits, and take NaN.
[[nodiscard]] CLI::Validator above_zero();
[[nodiscard]] CLI::Validator at_least_zero();

}  // namespace oneac::app
