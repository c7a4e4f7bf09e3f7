#pragma once

#include <string>
#include <vector>

namespace oneac {

/// What a finished program left behind.
struct ProgramResult {
  int exit_code = -1;  ///< 128 + signal when it was killed
  std::string out;     ///< stdout
  std::string err;     ///< stderr
};

/// Runs a program with its arguments (no shell in between), no standard input.
[[nodiscard]] ProgramResult run_program(const std::vector<std::string>& command);

}  // namespace oneac
