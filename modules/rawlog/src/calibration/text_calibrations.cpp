#include "calibration/text_calibrations.h"

#include "calibration/calibration_numbers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <memory>
#include <sstream>
#include <utility>

namespace oneac {
namespace {

using Words = std::vector<std::string>;

Words words_of(const std::string& line) {
  std::istringstream stream(line);
  Words words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

bool is_count(const std::string& word) {
  return !word.empty() && std::all_of(word.begin(), word.end(),
                                      [](unsigned char c) { return std::isdigit(c) != 0; });
}

bool is_model(const std::string& word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isupper(c) != 0 || c == '_';
  });
}

/// A COLMAP model's parameters: f or fx fy, cx cy, then so many terms of the lens.
struct ColmapModel {
  const char* name;
  bool one_focal;
  const char* lens;
  std::size_t terms;
};

constexpr std::array<ColmapModel, 9> kColmapModels{{{"SIMPLE_PINHOLE", true, "none", 0},
                                                    {"PINHOLE", false, "none", 0},
                                                    {"SIMPLE_RADIAL", true, "plumb_bob", 1},
                                                    {"RADIAL", true, "plumb_bob", 2},
                                                    {"OPENCV", false, "plumb_bob", 4},
                                                    {"FULL_OPENCV", false, "rational", 8},
                                                    {"SIMPLE_RADIAL_FISHEYE", true, "fisheye", 1},
                                                    {"RADIAL_FISHEYE", true, "fisheye", 2},
                                                    {"OPENCV_FISHEYE", false, "fisheye", 4}}};

const ColmapModel& colmap_model(const std::string& name, const CalibrationPlace& place) {
  for (const ColmapModel& model : kColmapModels) {
    if (name == model.name) return model;
  }
  place.fail("the camera model '" + name + "' is not supported",
             "undistort with COLMAP's image_undistorter and give the cameras.txt of its result");
}

PinholeCamera read_colmap(const Words& words, const CalibrationPlace& place) {
  constexpr std::size_t kHead = 4;             // id, model, width, height
  constexpr double kCentreOfFirstPixel = 0.5;  // COLMAP's corner of the image is (0, 0)
  const ColmapModel& model = colmap_model(words[1], place);
  PinholeCamera camera;
  set_size(place.numbers("the size", {words[2], words[3]}), "the size", place, camera);
  auto values = place.numbers(model.name, Words(words.begin() + kHead, words.end()));
  const std::size_t expected = (model.one_focal ? 3U : 4U) + model.terms;
  if (values.size() != expected) {
    place.fail(std::string(model.name) + " has " + std::to_string(values.size()) + " parameters",
               "it needs " + std::to_string(expected));
  }
  if (model.one_focal) values.insert(values.begin(), values.front());
  set_intrinsics(
      {values[0], values[1], values[2] - kCentreOfFirstPixel, values[3] - kCentreOfFirstPixel},
      model.name, place, camera);
  set_lens(model.lens, {values.begin() + 4, values.end()}, place, camera);
  return camera;
}

using KittiLines = std::map<std::string, Words>;

PinholeCamera read_kitti_raw(const std::filesystem::path& file, const KittiLines& lines,
                             const std::string& matrix, const std::string& size,
                             const std::string& lens) {
  const CalibrationPlace place(file, "section [" + matrix + "]");
  const auto numbers = [&](const std::string& key) {
    const auto line = lines.find(key);
    if (line == lines.end()) place.fail("the line " + key + ": is missing", "get the file again");
    return place.numbers(key, line->second);
  };
  PinholeCamera camera;
  set_matrix(numbers(matrix), matrix, place, camera);
  set_size(numbers(size), size, place, camera);
  if (!lens.empty()) set_lens("plumb_bob", numbers(lens), place, camera);
  return camera;
}

}  // namespace

CalibrationEntries colmap_calibrations(const std::filesystem::path& file, const std::string& text) {
  CalibrationEntries entries;
  std::istringstream stream(text);
  std::size_t number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const Words words = words_of(line);
    if (words.empty() || words.front().front() == '#') continue;
    const bool camera = words.size() >= 5 && is_count(words[0]) && is_model(words[1]);
    if (!camera) return {};
    const CalibrationPlace place(file, "line " + std::to_string(number));
    entries.push_back({words[0], true, [=] { return read_colmap(words, place); }});
  }
  return entries;
}

CalibrationEntries kitti_raw_calibrations(const std::filesystem::path& file,
                                          const std::string& text) {
  const auto lines = std::make_shared<KittiLines>();
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    const auto colon = line.find(':');
    if (colon != std::string::npos)
      (*lines)[line.substr(0, colon)] = words_of(line.substr(colon + 1));
  }
  CalibrationEntries entries;
  const auto add = [&](const std::string& kind, const std::string& size, const std::string& lens) {
    for (const auto& [key, words] : *lines) {
      if (key.size() != kind.size() + 2 || key.compare(0, kind.size(), kind) != 0) continue;
      const std::string id = key.substr(kind.size());
      entries.push_back({key, kind != "K_", [=, key = key] {
                           return read_kitti_raw(file, *lines, key, size + id,
                                                 lens.empty() ? "" : lens + id);
                         }});
    }
  };
  add("P_rect_", "S_rect_", "");
  add("K_", "S_", "D_");
  return entries;
}

}  // namespace oneac
