#pragma once

#include <filesystem>
#include <string>

namespace oneac::app {

/// A name that a run may write, and what files.json says of it.
struct ResultFile {
  enum class Rows { kNone, kLines, kLinesBelowHeader };

  const char* name;
  const char* content;  ///< in a few words
  const char* frame;    ///< of its poses or positions; "" where there are none
  bool lengths;         ///< holds some: in metres, or in units where the drive has no scale
  Rows rows;            ///< what a row is
};

/// One entry per name; a place to add a result. Its camera.ini may be another's.
struct ResultFiles {
  const ResultFile* begin() const;
  const ResultFile* end() const;
};

/// files.json: the results that are in the folder now, with frame, unit and rows.
/// @param metric  lengths are metres
[[nodiscard]] std::string manifest_json(const std::filesystem::path& folder, bool metric);

}  // namespace oneac::app
