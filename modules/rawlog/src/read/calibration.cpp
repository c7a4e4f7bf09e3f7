#include "oneac/rawlog/calibration.h"

#include "read/calibration_file.h"

#include "oneac/base/error.h"

#include <algorithm>
#include <cctype>

namespace oneac {
namespace {

namespace fs = std::filesystem;

struct Wanted {
  std::string file;
  std::string section;
};

// The whole text is tried as a name first: file names may hold a colon.
Wanted split(const std::string& file_and_section) {
  std::error_code ignored;
  const auto colon = file_and_section.rfind(':');
  if (colon == std::string::npos || fs::is_regular_file(file_and_section, ignored)) {
    return {file_and_section, ""};
  }
  return {file_and_section.substr(0, colon), file_and_section.substr(colon + 1)};
}

std::string joined(const std::vector<std::string>& names) {
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::vector<std::string> named_after(const std::string& side,
                                     const std::vector<std::string>& names) {
  std::vector<std::string> matching;
  if (side.empty()) return matching;
  std::copy_if(names.begin(), names.end(), std::back_inserter(matching), [&](const auto& name) {
    return lower(name).find(lower(side)) != std::string::npos;
  });
  return matching;
}

std::string choose(const Wanted& wanted, const std::vector<std::string>& names,
                   const std::string& side) {
  const auto has = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const std::string list = "the sections that exist: " + joined(names);
  if (names.empty()) {
    throw InputError(wanted.file, "it holds no camera calibration",
                     "give a camera_params file, an MRPT camera section or a KITTI calib.txt");
  }
  if (!wanted.section.empty()) {
    if (has(wanted.section)) return wanted.section;
    throw InputError(wanted.file, "it has no camera section '" + wanted.section + "'", list);
  }
  if (names.size() == 1) return names.front();
  if (has("P0")) return "P0";
  const auto matching = named_after(side, names);
  if (matching.size() == 1) return matching.front();
  throw InputError(wanted.file, "it has several sections", "give FILE:SECTION; " + list);
}

}  // namespace

PinholeCamera load_calibration(const std::string& file_and_section,
                               const std::string& preferred_side) {
  const Wanted wanted = split(file_and_section);
  std::error_code ignored;
  if (!fs::is_regular_file(wanted.file, ignored)) {
    throw InputError(wanted.file, "no such calibration file", "give FILE or FILE:SECTION");
  }
  const CalibrationFile file = read_calibration_file(wanted.file);
  return parse_camera(file, choose(wanted, camera_sections(file), preferred_side));
}

}  // namespace oneac
