#pragma once

#include <stdexcept>
#include <string>

namespace oneac {

/// Input that cannot be used: one line that names the file, what is wrong in it and the cure.
///
/// Thrown by readers and by checks of user input; the program turns it into exit code 2.
/// Nothing that was computed before it is lost: whoever holds results writes them first.
class InputError : public std::runtime_error {
 public:
  /// @param where  file (and record) concerned, e.g. "drive.rawlog: record 12"
  /// @param fault  what is wrong, e.g. "the gzip stream ends early"
  /// @param cure   what the user can do about it, e.g. "copy the file again"
  InputError(const std::string& where, const std::string& fault, const std::string& cure);
};

/// A file that could not be written (disk full, read-only): exit code 1, or 2 where
/// the user named it.
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::string& where, const std::string& fault, const std::string& cure);
};

}  // namespace oneac
