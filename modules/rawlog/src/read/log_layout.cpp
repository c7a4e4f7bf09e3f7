#include "read/log_layout.h"

#include <algorithm>
#include <regex>

namespace oneac {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& log) {
  return log.has_parent_path() ? log.parent_path() : fs::path(".");
}

/// "07" for the log of an extract of the Málaga Urban Dataset, else "".
std::string malaga_extract(const fs::path& log) {
  static const std::regex kName(R"(malaga-urban-dataset-extract-(\d\d).*)");
  std::smatch match;
  const std::string name = log.filename().string();
  return std::regex_match(name, match, kName) ? match[1].str() : "";
}

bool has_camera_params(const fs::path& folder) {
  std::error_code unreadable;
  const fs::directory_iterator entries(folder, unreadable);
  return std::any_of(begin(entries), end(entries), [](const fs::directory_entry& entry) {
    return entry.path().filename().string().rfind("camera_params_", 0) == 0;
  });
}

std::string missing_images(const LogSummary& summary) {
  std::size_t present = 0;
  std::size_t images = 0;
  for (const CameraSummary& camera : summary.cameras) {
    present += camera.present;
    images += camera.images;
  }
  if (present == images) return "";
  const fs::path folder = summary.image_folders.empty() ? folder_of(summary.log) / "Images"
                                                        : fs::path(summary.image_folders.front());
  return "  " + std::to_string(images - present) + " of " + std::to_string(images) +
         " images: put them into " + folder.string() + ", or name their folder with --images-dir\n";
}

std::string missing_calibration(const LogSummary& summary, bool malaga) {
  if (summary.calibration_overridden) return "";
  if (malaga && !has_camera_params(folder_of(summary.log))) {
    return "  camera_params_*.txt: the calibration of rectified images, for --calibration\n";
  }
  const bool usable =
      std::all_of(summary.cameras.begin(), summary.cameras.end(),
                  [](const CameraSummary& camera) { return camera.calibration.has_value(); });
  return usable ? "" : "  a calibration: give one with --calibration FILE[:SECTION]\n";
}

}  // namespace

std::string missing_lines(const LogSummary& summary) {
  if (summary.cameras.empty()) return "";
  const std::string extract = malaga_extract(summary.log);
  std::string lines = missing_images(summary) + missing_calibration(summary, !extract.empty());
  if (lines.empty()) return "";
  if (!extract.empty()) {
    lines += "  all of it: datasets/fetch.sh malaga-" + extract +
             ", or https://www.mrpt.org/MalagaUrbanDataset\n";
  }
  return "missing\n" + lines;
}

}  // namespace oneac
