#include "read/calibration_file.h"

#include "calibration/calibration_numbers.h"

#include "oneac/base/error.h"
#include "oneac/base/finite_number.h"
#include "oneac/base/input_file.h"
#include "oneac/base/number_text.h"
#include "oneac/observations/camera_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

namespace oneac {
namespace {

constexpr const char* kSpaces = " \t\r\n";
constexpr const char* kCameraKeys = "it needs resolution, cx, cy, fx, fy and dist";

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(kSpaces);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(kSpaces) - begin + 1);
}

// "//" and "#" open a comment anywhere, ';' only at the start: it separates the rows of a matrix.
std::string without_comment(const std::string& line) {
  const std::string text = trimmed(line.substr(0, std::min(line.find("//"), line.find('#'))));
  return !text.empty() && text.front() == ';' ? "" : text;
}

// Numbers of "[1 2; 3, 4]"; empty when something else is among them.
std::vector<double> numbers(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '[' || c == ']' || c == ',' || c == ';'; },
      ' ');
  std::vector<double> values;
  for (std::size_t at = text.find_first_not_of(kSpaces); at != std::string::npos;) {
    const auto end = text.find_first_of(kSpaces, at);
    const auto value = finite_number(text.substr(at, end - at));
    if (!value) return {};
    values.push_back(*value);
    at = text.find_first_not_of(kSpaces, end);
  }
  return values;
}

struct SectionReader {
  const CalibrationFile& file;
  const std::string& name;
  const CalibrationSection& entries;

  [[noreturn]] void fail(const std::string& fault) const {
    throw InputError(file.path.string() + ": section [" + name + "]", fault, kCameraKeys);
  }
  [[nodiscard]] std::vector<double> list(const std::string& key) const {
    const auto entry = entries.find(key);
    if (entry == entries.end()) fail(key + " is missing");
    auto values = numbers(entry->second);
    if (values.empty()) fail(key + " = '" + entry->second + "' is not made of numbers");
    return values;
  }
  [[nodiscard]] double scalar(const std::string& key) const {
    const auto values = list(key);
    if (values.size() != 1) fail(key + " is not one number");
    return values.front();
  }
};

// MRPT's releases name the model "distortion" or "distortion_model".
std::string lens_model(const SectionReader& reader) {
  for (const char* key : {"distortion", "distortion_model"}) {
    const auto model = reader.entries.find(key);
    if (model != reader.entries.end()) return model->second;
  }
  return "plumb_bob";
}

void read_distortion(const SectionReader& reader, PinholeCamera& camera) {
  const std::string model = lens_model(reader);
  auto k = reader.entries.count("dist") == 0 ? std::vector<double>{} : reader.list("dist");
  if (model == "kannala_brandt" && k.size() == camera.distortion.size()) {
    std::array<double, 8> stored{};
    std::copy(k.begin(), k.end(), stored.begin());
    const auto terms = fisheye_terms_of_mrpt(stored);
    if (!terms) reader.fail("dist has terms beyond k1 k2 k3 k4");
    k.assign(terms->begin(), terms->end());
  }
  const CalibrationPlace place(reader.file.path, "section [" + reader.name + "]");
  set_lens(model, k, place, camera);
}

PinholeCamera parse_sections(const SectionReader& reader) {
  PinholeCamera camera;
  const auto size = reader.list("resolution");
  constexpr double kLargestSide = 1e6;  // [px], so that the conversion below is defined
  const bool sane = size.size() == 2 && size[0] >= 1 && size[1] >= 1 && size[0] < kLargestSide &&
                    size[1] < kLargestSide;
  if (!sane) reader.fail("resolution is not [width height]");
  camera.width = static_cast<int>(size[0]);
  camera.height = static_cast<int>(size[1]);
  camera.fx = reader.scalar("fx");
  camera.fy = reader.scalar("fy");
  camera.cx = reader.scalar("cx");
  camera.cy = reader.scalar("cy");
  read_distortion(reader, camera);
  return camera;
}

// P = K [I | t], row-major 3×4.
PinholeCamera parse_kitti(const SectionReader& reader) {
  const auto P = reader.list(kKittiKey);
  if (P.size() != 12) reader.fail("it does not hold twelve numbers");
  constexpr double kNone = 1e-6;  // of what a P of rectified images has no place for
  const bool upper = std::abs(P[1]) <= kNone * std::abs(P[0]) && std::abs(P[4]) <= kNone &&
                     std::abs(P[8]) <= kNone && std::abs(P[9]) <= kNone &&
                     std::abs(P[10] - 1.0) <= kNone;
  const bool has_focal = P[0] > 0.0 && P[5] > 0.0;  // else that is what is said
  if (has_focal && !upper) {
    throw InputError(reader.file.path.string() + ": " + reader.name,
                     "it has a skew, or is no K [I | t]: second number " + exact_text(P[1]),
                     "give fx 0 cx a, 0 fy cy b, 0 0 1 c of rectified images with square axes");
  }
  PinholeCamera camera;
  camera.fx = P[0];
  camera.cx = P[2];
  camera.fy = P[5];
  camera.cy = P[6];
  return camera;
}

bool is_projection_name(const std::string& name) {
  return !name.empty() && name.front() == 'P' && name.find_first_of(kSpaces) == std::string::npos;
}

}  // namespace

std::string calibration_text(const std::filesystem::path& path) {
  constexpr std::size_t kLongest = 1U << 20;  // a rig's calibration has some kB
  if (const std::string fault = fault_of_file(path); !fault.empty() && fault != "no such file") {
    throw InputError(path.string(), fault, "name a calibration file");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw InputError(path.string(), "the calibration cannot be opened", "check its name");
  std::string text(kLongest, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() == kLongest) {
    throw InputError(path.string(), "it is too long for a calibration", "check its name");
  }
  drop_byte_order_mark(text);
  return text;
}

CalibrationName calibration_name(const std::string& file_and_section) {
  std::error_code ignored;
  const auto colon = file_and_section.rfind(':');
  if (colon == std::string::npos || std::filesystem::is_regular_file(file_and_section, ignored)) {
    return {file_and_section, ""};
  }
  return {file_and_section.substr(0, colon), file_and_section.substr(colon + 1)};
}

CalibrationFile read_calibration_file(const std::filesystem::path& path) {
  return sections_of(path, calibration_text(path));
}

CalibrationFile sections_of(const std::filesystem::path& path, const std::string& text) {
  std::istringstream stream(text);
  CalibrationFile file{path, {}};
  std::string section;
  for (std::string line; std::getline(stream, line);) {
    const std::string entry = without_comment(line);
    if (entry.empty()) continue;
    if (entry.front() == '[' && entry.back() == ']') {
      section = trimmed(entry.substr(1, entry.size() - 2));
      file.sections[section];
      continue;
    }
    const auto split = entry.find_first_of("=:");
    if (split == std::string::npos) continue;
    const std::string key = trimmed(entry.substr(0, split));
    const std::string value = trimmed(entry.substr(split + 1));
    if (entry[split] == '=') {
      file.sections[section][key] = value;
    } else if (is_projection_name(key)) {
      file.sections[key][kKittiKey] = value;
    }
  }
  return file;
}

std::vector<std::string> camera_sections(const CalibrationFile& file) {
  std::vector<std::string> names;
  for (const auto& [name, entries] : file.sections) {
    const bool camera = entries.count("fx") != 0 || entries.count(kKittiKey) != 0;
    if (camera && !name.empty()) names.push_back(name);
  }
  return names;
}

PinholeCamera parse_camera(const CalibrationFile& file, const std::string& section) {
  const SectionReader reader{file, section, file.sections.at(section)};
  const bool kitti = reader.entries.count(kKittiKey) != 0;
  const PinholeCamera camera = kitti ? parse_kitti(reader) : parse_sections(reader);
  if (camera.fx <= 0.0 || camera.fy <= 0.0) reader.fail("the focal length is not positive");
  return camera;
}

}  // namespace oneac
