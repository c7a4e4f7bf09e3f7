#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace oneac::app {

/// Prints the help or version that was asked for, or one line about arguments that cannot be
/// understood; a verb that does not exist is named with the nearest one.
/// @param arguments  without the program's name @return the exit code: 0 or 2
[[nodiscard]] int answer_to(const CLI::ParseError& error, const CLI::App& program,
                            const std::vector<std::string>& arguments);

/// "oneac: what" on stderr, in one line that is safe to print. @return code
[[nodiscard]] int end_with(const std::string& what, int code);

}  // namespace oneac::app
