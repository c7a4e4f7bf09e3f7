#include "result_files.h"

#include "oneac/base/version.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <system_error>

namespace oneac::app {
namespace {

using Rows = ResultFile::Rows;

constexpr const char* kFirstCamera = "first camera (X right, Y down, Z forward)";
constexpr const char* kFirstVehicle = "first vehicle pose (X forward, Y left, Z up)";
constexpr const char* kSecondCamera = "second camera of each pair";
constexpr const char* kEarth = "WGS84";

constexpr std::array kFiles{
    ResultFile{"trajectory_camera.kitti", "camera, per frame", kFirstCamera, true, Rows::kLines},
    ResultFile{"trajectory_camera.tum", "camera, per frame", kFirstCamera, true, Rows::kLines},
    ResultFile{"trajectory_vehicle.tum", "vehicle, per frame", kFirstVehicle, true, Rows::kLines},
    ResultFile{"trajectory_enu.tum", "vehicle, per frame", "east, north, up of the first GPS fix",
               true, Rows::kLines},
    ResultFile{"trajectory.gpx", "vehicle, per frame", kEarth, false, Rows::kNone},
    ResultFile{"trajectory.kml", "vehicle, per frame", kEarth, false, Rows::kNone},
    ResultFile{"relative_poses.csv", "X2 = R X1 + t, per pair", kSecondCamera, true,
               Rows::kLinesBelowHeader},
    ResultFile{"covariance.csv", "covariance of (w, t), per pair", kSecondCamera, true,
               Rows::kLinesBelowHeader},
    ResultFile{"tilt.csv", "tilt of the camera, per frame", "", false, Rows::kLinesBelowHeader},
    ResultFile{"timings.csv", "CPU time, per pair", "", false, Rows::kLinesBelowHeader},
    ResultFile{"keyframes.tum", "camera, per keyframe", kFirstCamera, true, Rows::kLines},
    ResultFile{"graph.g2o", "keyframes and constraints", kFirstCamera, true, Rows::kLines},
    ResultFile{"map.simplemap", "MRPT's map of the keyframes", kFirstVehicle, true, Rows::kNone},
    ResultFile{"points.ply", "landmarks", kFirstCamera, true, Rows::kNone},
    ResultFile{"loops.csv", "X2 = R X1 + t, per loop", kSecondCamera, true,
               Rows::kLinesBelowHeader},
    ResultFile{"trajectory_optimised_camera.kitti", "camera, per frame, loops closed", kFirstCamera,
               true, Rows::kLines},
    ResultFile{"trajectory_optimised_camera.tum", "camera, per frame, loops closed", kFirstCamera,
               true, Rows::kLines},
    ResultFile{"trajectory_optimised_vehicle.tum", "vehicle, per frame, loops closed",
               kFirstVehicle, true, Rows::kLines},
    ResultFile{"keyframes_optimised.tum", "camera, per keyframe, loops closed", kFirstCamera, true,
               Rows::kLines},
    ResultFile{"mask.png", "what belongs to the car", "", false, Rows::kNone},
    ResultFile{"camera.ini", "camera of the raw images as used", "", false, Rows::kNone},
    ResultFile{"params.yaml", "effective parameters", "", false, Rows::kNone},
    ResultFile{"summary.json", "counts, scale, tilt, errors", "", false, Rows::kNone},
    ResultFile{"report.html", "plots and worst frames", "", false, Rows::kNone},
    ResultFile{"files.json", "this list", "", false, Rows::kNone},
};

std::size_t lines_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return static_cast<std::size_t>(
      std::count(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>(), '\n'));
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
  if (file.rows != Rows::kNone) {
    const std::size_t header = file.rows == Rows::kLinesBelowHeader ? 1 : 0;
    const std::size_t lines = lines_of(folder / file.name);
    entry["rows"] = lines - std::min(lines, header);
  }
  return entry;
}

}  // namespace

const ResultFile* ResultFiles::begin() const {
  return kFiles.data();
}
const ResultFile* ResultFiles::end() const {
  return kFiles.data() + kFiles.size();
}

std::string manifest_json(const std::filesystem::path& folder, bool metric) {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const ResultFile& file : kFiles) {
    std::error_code ignored;
    const bool is_this_list = std::string(file.name) == "files.json";
    if (!is_this_list && !std::filesystem::is_regular_file(folder / file.name, ignored)) continue;
    files.push_back(entry_of(file, folder, metric));
  }
  return nlohmann::ordered_json{{"by", "oneac " + version()}, {"files", files}}.dump(2) + "\n";
}

}  // namespace oneac::app
