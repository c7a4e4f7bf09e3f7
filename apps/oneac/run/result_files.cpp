#include "result_files.h"

#include "terminal/own_results.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/input_file.h"
#include "oneac/base/version.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <vector>

namespace oneac::app {
namespace {

/// A name that a run may write, and what files.json says of it.
struct ResultFile {
  enum class Rows { kNone, kLines, kLinesBelowHeader, kVertices, kTrackPoints, kCoordinates };

  const char* name;
  const char* content;  ///< in a few words
  const char* frame;    ///< of its poses or positions; "" where there are none
  bool lengths;         ///< holds some: in metres, or in units where the drive has no scale
  Rows rows;            ///< what a row is
};

using Rows = ResultFile::Rows;

constexpr const char* kFirstCamera = "first camera (X right, Y down, Z forward)";
constexpr const char* kFirstVehicle = "first vehicle pose (X forward, Y left, Z up)";
constexpr const char* kSecondCamera = "second camera of each pair";
constexpr const char* kEarth = "WGS84";

// In the order in which a run names them.
constexpr std::array kFiles{
    ResultFile{"trajectory_camera.kitti", "camera, per frame", kFirstCamera, true, Rows::kLines},
    ResultFile{"trajectory_camera.tum", "camera, per frame", kFirstCamera, true, Rows::kLines},
    ResultFile{"trajectory_vehicle.tum", "vehicle, per frame", kFirstVehicle, true, Rows::kLines},
    ResultFile{"trajectory_camera.csv", "camera with covariance, per frame", kFirstCamera, true,
               Rows::kLinesBelowHeader},
    ResultFile{"trajectory_vehicle.csv", "vehicle with covariance, per frame", kFirstVehicle, true,
               Rows::kLinesBelowHeader},
    ResultFile{"relative_poses.csv", "X2 = R X1 + t, per pair", kSecondCamera, true,
               Rows::kLinesBelowHeader},
    ResultFile{"covariance.csv", "covariance of (w, t), per pair", kSecondCamera, true,
               Rows::kLinesBelowHeader},
    ResultFile{"tilt.csv", "tilt of the camera, per frame", "", false, Rows::kLinesBelowHeader},
    ResultFile{"timings.csv", "CPU time, per pair", "", false, Rows::kLinesBelowHeader},
    ResultFile{"summary.json", "counts, scale, tilt, errors", "", false, Rows::kNone},
    ResultFile{"report.html", "plots and worst frames", "", false, Rows::kNone},
    ResultFile{"params.yaml", "effective parameters", "", false, Rows::kNone},
    ResultFile{"files.json", "this list", "", false, Rows::kNone},
    ResultFile{"keyframes.tum", "camera, per keyframe", kFirstCamera, true, Rows::kLines},
    ResultFile{"graph.g2o", "keyframes and constraints", kFirstCamera, true, Rows::kLines},
    ResultFile{"map.simplemap", "MRPT's map of the keyframes", kFirstVehicle, true, Rows::kNone},
    ResultFile{"points.ply", "landmarks", kFirstCamera, true, Rows::kVertices},
    ResultFile{"loops.csv", "X2 = R X1 + t, per loop", kSecondCamera, true,
               Rows::kLinesBelowHeader},
    ResultFile{"trajectory_optimised_camera.kitti", "camera, per frame, loops closed", kFirstCamera,
               true, Rows::kLines},
    ResultFile{"trajectory_optimised_camera.tum", "camera, per frame, loops closed", kFirstCamera,
               true, Rows::kLines},
    ResultFile{"trajectory_optimised_vehicle.tum", "vehicle, per frame, loops closed",
               kFirstVehicle, true, Rows::kLines},
    ResultFile{"trajectory_optimised_camera.csv", "camera with covariance, per frame, loops closed",
               kFirstCamera, true, Rows::kLinesBelowHeader},
    ResultFile{"trajectory_optimised_vehicle.csv",
               "vehicle with covariance, per frame, loops closed", kFirstVehicle, true,
               Rows::kLinesBelowHeader},
    ResultFile{"keyframes_optimised.tum", "camera, per keyframe, loops closed", kFirstCamera, true,
               Rows::kLines},
    ResultFile{"camera.ini", "camera of the raw images as used", "", false, Rows::kNone},
    ResultFile{"trajectory.gpx", "vehicle, per frame", kEarth, false, Rows::kTrackPoints},
    ResultFile{"trajectory.kml", "vehicle, per frame", kEarth, false, Rows::kCoordinates},
    ResultFile{"trajectory_enu.tum", "vehicle, per frame", "east, north, up of the first GPS fix",
               true, Rows::kLines},
    ResultFile{"mask.png", "what belongs to the car", "", false, Rows::kNone},
};

constexpr const char* kCameraFile = "camera.ini";
// What the first line of it begins with: others write files of this name.
constexpr const char* kOfARun = "// used by oneac run";

/// Names that people give their own files, too: a run's have this at their beginning.
constexpr ResultMark kSignatures[] = {{"trajectory.gpx", "creator=\"oneac"},
                                      {"trajectory.kml", "<name>oneac</name>"},
                                      {"files.json", "\"by\": \"oneac"}};

bool begins_with(const std::filesystem::path& file, std::string_view text) {
  return beginning_of(file, text.size()) == text;
}

/// Not what a run has written.
bool belongs_to_others(std::string_view name, const std::filesystem::path& file) {
  for (const ResultMark& signature : kSignatures) {
    if (name == signature.name) return !has_mark(file, signature.mark);
  }
  return name == kCameraFile && !begins_with(file, kOfARun);
}

/// What an earlier run has left in a folder.
class EarlierRun {
 public:
  explicit EarlierRun(const std::filesystem::path& folder) : folder_(folder) {
    // The first file of every run, and those that others do not write; the list is its last.
    left_some_ = fault_of_file(folder / "trajectory_camera.kitti").empty() ||
                 begins_with(folder / "relative_poses.csv", "index1,index2,t1,t2,") ||
                 begins_with(folder / "summary.json", "{\n  \"version\": \"");
    if (belongs_to_others("files.json", folder / "files.json")) return;
    std::ifstream in(folder / "files.json");
    const auto list = nlohmann::json::parse(in, nullptr, false);
    if (!list.is_object() || !list.contains("files") || !list["files"].is_array()) return;
    listed_.emplace();
    for (const auto& file : list["files"]) {
      if (file.is_object() && file.contains("name") && file["name"].is_string()) {
        listed_->insert(file["name"].get<std::string>());
      }
    }
  }

  /// Where a run did not come to its list, all that has the name of a result is taken for its own.
  [[nodiscard]] bool wrote(std::string_view name) const {
    if (belongs_to_others(name, folder_ / name)) return false;
    return listed_ ? listed_->count(name) > 0 : left_some_;
  }

 private:
  std::filesystem::path folder_;
  bool left_some_ = false;
  std::optional<std::set<std::string, std::less<>>> listed_;
};

bool is_input(const std::filesystem::path& file, const std::vector<std::string>& inputs) {
  return std::any_of(inputs.begin(), inputs.end(),
                     [&](const std::string& input) { return is_same_file(file, input); });
}

void require_own_result(const std::filesystem::path& file, const EarlierRun& earlier,
                        const std::vector<std::string>& inputs) {
  const std::string another = "name another folder with -o";
  require_result_place(file);
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return;  // or a link to what will be written
  if (is_input(file, inputs)) {
    throw InputError(file.string(), "is read by this run, whose results would replace it", another);
  }
  if (earlier.wrote(file.filename().string())) return;
  throw InputError(file.string(), "no run has written it, and this one would overwrite it",
                   another);
}

std::size_t lines_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return static_cast<std::size_t>(
      std::count(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>(), '\n'));
}

/// What the header of a PLY says.
std::size_t vertices_of(const std::filesystem::path& file) {
  constexpr std::string_view kElement = "element vertex ";
  constexpr int kMostLines = 50;
  std::ifstream in(file, std::ios::binary);
  std::string line;
  for (int i = 0; i < kMostLines && std::getline(in, line); ++i) {
    if (line.rfind(kElement, 0) != 0) continue;
    std::size_t count = 0;
    std::from_chars(line.data() + kElement.size(), line.data() + line.size(), count);
    return count;
  }
  return 0;
}

template <class Predicate>
std::size_t lines_that(const std::filesystem::path& file, Predicate&& holds) {
  std::ifstream in(file);
  std::size_t count = 0;
  for (std::string line; std::getline(in, line);) count += holds(line) ? 1U : 0U;
  return count;
}

std::size_t rows_of(const ResultFile& file, const std::filesystem::path& path) {
  switch (file.rows) {
    case Rows::kLines:
      return lines_of(path);
    case Rows::kLinesBelowHeader:
      return std::max<std::size_t>(lines_of(path), 1) - 1;
    case Rows::kVertices:
      return vertices_of(path);
    case Rows::kTrackPoints:
      return lines_that(
          path, [](const std::string& line) { return line.find("<trkpt ") != std::string::npos; });
    case Rows::kCoordinates:  // longitude,latitude,altitude
      return lines_that(path, [](const std::string& line) {
        return line.find('<') == std::string::npos &&
               std::count(line.begin(), line.end(), ',') == 2;
      });
    case Rows::kNone:
      break;
  }
  return 0;
}

/// Whether a run has written it, to this folder.
bool is_there(const ResultFile& result, const std::filesystem::path& folder) {
  std::error_code ignored;
  const std::filesystem::path file = folder / result.name;
  return std::filesystem::is_regular_file(file, ignored) && !belongs_to_others(result.name, file);
}

std::string unit_of(const ResultFile& file, bool metric) {
  if (file.frame == kEarth) return "degrees, m";
  if (!file.lengths) return "";
  return metric ? "m" : "units of the drive";
}

nlohmann::ordered_json entry_of(const ResultFile& file, const std::filesystem::path& folder,
                                bool metric) {
  nlohmann::ordered_json entry = {{"name", file.name}, {"content", file.content}};
  if (*file.frame != '\0') entry["frame"] = file.frame;
  if (const std::string unit = unit_of(file, metric); !unit.empty()) entry["unit"] = unit;
  if (file.rows != Rows::kNone) entry["rows"] = rows_of(file, folder / file.name);
  return entry;
}

/// Those of an earlier run of several logs: 1, 2, … beside its summary. Of another run, none.
std::vector<std::filesystem::path> folders_of_logs(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> folders;
  std::error_code ignored;
  const std::filesystem::path file = folder / "summary.json";
  if (!std::filesystem::is_regular_file(file, ignored)) return folders;
  std::ifstream in(file);
  const auto summary = nlohmann::json::parse(in, nullptr, false);
  if (!summary.is_object() || !summary.contains("logs")) return folders;
  for (std::size_t i = 1; i <= summary["logs"].size(); ++i) {
    const std::filesystem::path log = folder / std::to_string(i);
    // Not through a link: it may lead anywhere, also back here.
    const auto kind = std::filesystem::symlink_status(log, ignored).type();
    if (kind == std::filesystem::file_type::directory) folders.push_back(log);
  }
  return folders;
}

void clear_folder(const std::filesystem::path& folder) {
  const EarlierRun earlier(folder);
  std::vector<std::filesystem::path> own;
  for (const ResultFile& result : kFiles) {
    if (earlier.wrote(result.name)) own.push_back(replaced_file(folder / result.name));
  }
  std::error_code ignored;
  for (const std::filesystem::path& file : own) {
    if (fault_of_file(file).empty()) std::filesystem::remove(file, ignored);
  }
}

void require_own_results_in(const std::filesystem::path& folder, const ResultFolder& results) {
  const EarlierRun earlier(folder);
  for (const ResultFile& result : kFiles) {
    // Without learning it is neither written nor, where it is another's, taken away.
    const std::filesystem::path file = folder / result.name;
    const bool left_alone = std::string_view(result.name) == kCameraFile &&
                            !results.learns_camera && !earlier.wrote(result.name);
    if (!left_alone) require_own_result(file, earlier, results.inputs);
  }
}

}  // namespace

void require_own_results(const ResultFolder& results) {
  for (const std::filesystem::path& log : folders_of_logs(results.folder)) {
    require_own_results_in(log, results);
  }
  require_own_results_in(results.folder, results);
}

void clear_of_earlier_run(const std::filesystem::path& folder) {
  for (const std::filesystem::path& log : folders_of_logs(folder)) {
    clear_folder(log);
    std::error_code not_empty;  // what is not of a run stays, and the folder with it
    std::filesystem::remove(log, not_empty);
  }
  clear_folder(folder);
}

std::string names_of_results(const std::filesystem::path& folder) {
  std::string names;
  for (const ResultFile& file : kFiles) {
    if (is_there(file, folder)) names += (names.empty() ? "" : ", ") + std::string(file.name);
  }
  return names;
}

std::string manifest_json(const std::filesystem::path& folder, bool metric) {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const ResultFile& file : kFiles) {
    const bool is_this_list = std::string_view(file.name) == "files.json";
    if (is_this_list || is_there(file, folder)) files.push_back(entry_of(file, folder, metric));
  }
  return nlohmann::ordered_json{{"by", "oneac " + version()}, {"files", files}}.dump(2) + "\n";
}

}  // namespace oneac::app
