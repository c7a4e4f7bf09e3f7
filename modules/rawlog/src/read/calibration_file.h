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

/// @throws InputError when the file cannot be read
[[nodiscard]] CalibrationFile read_calibration_file(const std::filesystem::path& path);

/// Names of the sections that describe a camera, in alphabetical order.
[[nodiscard]] std::vector<std::string> camera_sections(const CalibrationFile& file);

/// @throws InputError naming file, section and key
[[nodiscard]] PinholeCamera parse_camera(const CalibrationFile& file, const std::string& section);

}  // namespace oneac
