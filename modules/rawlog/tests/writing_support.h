#pragma once

#include "oneac/base/error.h"

#include <mrpt/obs/CObservation.h>

#include <filesystem>
#include <string>
#include <vector>

namespace oneac::test {

/// All observations of a gzip-compressed log, read by MRPT.
std::vector<mrpt::obs::CObservation::Ptr> read_with_mrpt(const std::filesystem::path& log);

/// Those of one class.
template <class Observation>
std::vector<std::shared_ptr<Observation>> only(
    const std::vector<mrpt::obs::CObservation::Ptr>& observations) {
  std::vector<std::shared_ptr<Observation>> chosen;
  for (const auto& observation : observations) {
    if (auto match = std::dynamic_pointer_cast<Observation>(observation)) chosen.push_back(match);
  }
  return chosen;
}

/// The value of a field of MRPT's packed messages, to which no reference may be bound: it may lie
/// at any address.
template <class Value>
Value copied(Value field) {
  return field;
}

/// What MRPT's own `rawlog-edit --info` (Debian package mrpt-apps) says about a log: a judge that
/// this project did not write. Fails the test when the program is missing or fails.
std::string rawlog_edit_info(const std::filesystem::path& log);

std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);
/// A small grey image (.png or .jpg by its name); folders are made.
void write_image(const std::filesystem::path& file, int width = 64, int height = 48);
/// Names in a folder, sorted.
std::vector<std::string> names_in(const std::filesystem::path& folder);

/// What the InputError thrown by the call says; "" when it throws none.
template <class Call>
std::string complaint_of(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace oneac::test
