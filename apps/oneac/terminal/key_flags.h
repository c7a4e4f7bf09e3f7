#pragma once

#include "terminal/setting.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace oneac::app {

/// --params FILE, and --set section.key=value.
void add_parameters(CLI::App& verb, std::vector<std::string>& files,
                    std::vector<Setting>& settings);

/// A flag that is also a key: it is kept as a setting and applied after the files.
void add_key(CLI::App& verb, const std::string& flag, const std::string& key,
             std::vector<Setting>& settings, const std::string& help);

/// The flags that choose images and correspondences, the same for every verb that reads a drive.
void add_selection(CLI::App& verb, std::vector<Setting>& settings);

/// Checks of a flag: a finite number above 0, or of at least 0. CLI11's own name the largest double
/// in 309 digits, and take NaN.
[[nodiscard]] CLI::Validator above_zero();
[[nodiscard]] CLI::Validator at_least_zero();

/// Lets the options of all verbs that are numbers take decimal ones only, and those that are texts
/// none without a letter. CLI11 reads "0x2" as 2, "010" as 8, "" as 0 and "-1" as 2⁶⁴ − 1.
void check_values(CLI::App& program);

}  // namespace oneac::app
