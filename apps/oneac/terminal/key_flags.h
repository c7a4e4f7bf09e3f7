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

}  // namespace oneac::app
