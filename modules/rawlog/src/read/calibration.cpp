#include "oneac/rawlog/calibration.h"

#include "calibration/calibration_entry.h"
#include "calibration/flat_document.h"
#include "calibration/text_calibrations.h"
#include "calibration/yaml_calibrations.h"
#include "read/calibration_file.h"

#include "oneac/base/error.h"
#include "oneac/base/input_file.h"

#include <algorithm>
#include <cctype>
#include <memory>

namespace oneac {
namespace {

namespace fs = std::filesystem;

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

CalibrationEntries section_calibrations(const fs::path& path, const std::string& text) {
  const auto file = std::make_shared<const CalibrationFile>(sections_of(path, text));
  CalibrationEntries entries;
  for (const std::string& name : camera_sections(*file)) {
    entries.push_back({name, true, [file, name] { return parse_camera(*file, name); }});
  }
  return entries;
}

/// The cameras of a file, whose kind its content tells.
CalibrationEntries calibrations_in(const fs::path& path) {
  const std::string text = calibration_text(path);
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return {};
  if (text[first] == '<') return document_calibrations(flat_xml(path, text));
  if (is_calibration_yaml(path, text)) return document_calibrations(flat_yaml(path, text));
  if (auto entries = colmap_calibrations(path, text); !entries.empty()) return entries;
  if (auto entries = kitti_raw_calibrations(path, text); !entries.empty()) return entries;
  return section_calibrations(path, text);
}

const CalibrationEntry& choose(const CalibrationName& wanted, const CalibrationEntries& entries,
                               const std::string& side) {
  std::vector<std::string> all, offered;
  for (const CalibrationEntry& entry : entries) {
    all.push_back(entry.section);
    if (entry.offered) offered.push_back(entry.section);
  }
  const auto named = [&](const std::string& name) -> const CalibrationEntry* {
    const auto found = std::find(all.begin(), all.end(), name);
    return found == all.end() ? nullptr : &entries[static_cast<std::size_t>(found - all.begin())];
  };
  const std::string list = "the sections that exist: " + joined(all);
  if (all.empty()) {
    throw InputError(wanted.file.string(), "it holds no camera calibration",
                     "give an MRPT camera section, or a calibration of KITTI, OpenCV, ROS, Kalibr, "
                     "COLMAP or ORB-SLAM");
  }
  if (!wanted.section.empty()) {
    if (const auto* entry = named(wanted.section)) return *entry;
    throw InputError(wanted.file.string(), "it has no camera section '" + wanted.section + "'",
                     list);
  }
  if (offered.size() == 1) return *named(offered.front());
  for (const char* first : {"P0", "P_rect_00"}) {
    if (const auto* entry = named(first)) return *entry;
  }
  const auto matching = named_after(side, offered);
  if (matching.size() == 1) return *named(matching.front());
  throw InputError(wanted.file.string(), "it has several sections", "give FILE:SECTION; " + list);
}

}  // namespace

PinholeCamera load_calibration(const std::string& file_and_section,
                               const std::string& preferred_side) {
  const CalibrationName wanted = calibration_name(file_and_section);
  if (const std::string fault = fault_of_file(wanted.file); !fault.empty()) {
    const bool missing = fault == "no such file";
    throw InputError(wanted.file.string(), missing ? "no such calibration file" : fault,
                     "give FILE or FILE:SECTION");
  }
  const CalibrationEntries entries = calibrations_in(wanted.file);
  return choose(wanted, entries, preferred_side).read();
}

}  // namespace oneac
