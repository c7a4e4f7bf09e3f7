#pragma once

#include "oneac/geometry/camera.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace oneac {

/// The entries of one section of a calibration file, values as text.
using CalibrationSection = std::map<std::string, std::string>;

/// A calibration file by sections. A line "P0: …" of a KITTI file is a section with the entry
/// kKittiKey.
struct CalibrationFile {
  std::filesystem::path path;
  std::map<std::string, CalibrationSection> sections;
};

inline constexpr const char* kKittiKey = "projection";

/// FILE and SECTION of FILE[:SECTION]; section "": none is named.
struct CalibrationName {
  std::filesystem::path file;
  std::string section;
};

/// The whole text is tried as a name first: file names may hold a colon.
[[nodiscard]] CalibrationName calibration_name(const std::string& file_and_section);

/// The text of a calibration file without a byte-order mark.
/// @throws InputError when it cannot be read or is longer than a MB
[[nodiscard]] std::string calibration_text(const std::filesystem::path& path);

[[nodiscard]] CalibrationFile sections_of(const std::filesystem::path& path,
                                          const std::string& text);

/// @throws InputError as calibration_text()
[[nodiscard]] CalibrationFile read_calibration_file(const std::filesystem::path& path);

/// Names of the sections that describe a camera, in alphabetical order.
[[nodiscard]] std::vector<std::string> camera_sections(const CalibrationFile& file);

/// @throws InputError naming file, section and key
[[nodiscard]] PinholeCamera parse_camera(const CalibrationFile& file, const std::string& section);

}  // namespace oneac
