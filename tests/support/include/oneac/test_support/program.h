#pragma once

#include "oneac/test_support/temporary_folder.h"

#include <sys/types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace oneac {

/// What a finished program left behind.
struct ProgramResult {
  int exit_code = -1;        ///< 128 + signal when it was killed
  std::string out;           ///< stdout
  std::string err;           ///< stderr
  std::size_t peak_mb = 0;   ///< most memory resident at once [MiB]
  double cpu_seconds = 0.0;  ///< user and system time of all its threads [s]
};

/// A program at work, without a shell in between and without standard input.
class RunningProgram {
 public:
  /// @param largest_file_bytes  writing on fails beyond (EFBIG), as on a full disk; 0: no limit
  explicit RunningProgram(const std::vector<std::string>& command,
                          std::size_t largest_file_bytes = 0);
  ~RunningProgram();  ///< kills it when nobody waited
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  void send(int signal) const;
  /// Whether it has ended (not waited for yet).
  [[nodiscard]] bool has_ended() const;
  /// Of all its threads so far [s]; stands still while the machine holds it.
  [[nodiscard]] double cpu_seconds() const;
  [[nodiscard]] ProgramResult wait();

 private:
  TemporaryFolder folder_;
  pid_t child_ = -1;
};

/// Runs a program with its arguments (no shell in between), no standard input.
[[nodiscard]] ProgramResult run_program(const std::vector<std::string>& command);

}  // namespace oneac
