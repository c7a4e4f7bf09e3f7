// Datasets that list time and name of each image: EuRoC, TUM RGB-D.
#include "import/image_drive.h"
#include "import/import_images.h"
#include "import/stamps.h"

#include "oneac/base/error.h"
#include "oneac/base/input_file.h"

#include <cctype>
#include <fstream>
#include <string_view>
#include <utility>

namespace oneac {
namespace {

namespace fs = std::filesystem;

struct Listed {
  std::vector<fs::path> images;
  std::vector<double> times_s;
};

struct ListLine {
  std::string time, name;
};

/// Without blanks and quotes around it.
std::string bare(std::string_view text) {
  constexpr std::string_view kAround = " \t\r\"'";
  const auto first = text.find_first_not_of(kAround);
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(kAround) + 1 - first));
}

/// Behind a comma the next field, with its blanks and '#'; empty time: no image.
ListLine fields_of(std::string_view line) {
  const std::size_t comma = line.find(',');
  const std::string_view behind = line.substr(comma + 1);
  return {bare(line.substr(0, comma)), bare(behind.substr(0, behind.find(',')))};
}

/// A name with blanks where such an image is there, else the next word.
ListLine words_of(std::string_view line, const fs::path& folder) {
  const std::string text = bare(line.substr(0, line.find(" #")));
  const std::size_t blank = text.find_first_of(" \t");
  if (blank == std::string::npos) return {text, ""};
  const std::string behind = bare(std::string_view(text).substr(blank));
  std::error_code ignored;
  const bool whole = fs::is_regular_file(folder / behind, ignored);
  return {text.substr(0, blank), whole ? behind : behind.substr(0, behind.find_first_of(" \t"))};
}

/// A first line may name the columns.
bool is_heading(const ListLine& line, const fs::path& folder) {
  std::error_code ignored;
  return !line.time.empty() && std::isdigit(static_cast<unsigned char>(line.time.front())) == 0 &&
         !fs::is_regular_file(folder / line.name, ignored);
}

/// Lines "time name" or "time,name" with times since 1970; '#' begins a comment.
Listed read_list(const fs::path& file, const fs::path& folder) {
  std::ifstream stream = open_input(file, "give a folder that has it");
  Listed listed;
  std::size_t number = 0;
  bool is_first = true;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (number == 1) drop_byte_order_mark(line);
    const bool commas = line.find(',') != std::string::npos;
    const ListLine entry = commas ? fields_of(line) : words_of(line, folder);
    if (bare(line).empty() || bare(line).front() == '#') continue;
    if (std::exchange(is_first, false) && is_heading(entry, folder)) continue;
    const std::string where = file.string() + ": line " + std::to_string(number);
    const double time_s = seconds_since_1970(entry.time);
    if (entry.name.empty() || time_s < 0.0) {
      throw InputError(where, "is no time since 1970 and name of an image",
                       "get the file again from its source");
    }
    if (!listed.times_s.empty() && !(time_s > listed.times_s.back())) {
      throw InputError(where, "time does not increase", "sort the file by time");
    }
    listed.times_s.push_back(time_s);
    listed.images.push_back(folder / entry.name);
  }
  return listed;
}

/// Images that are not there are left out, and said.
Listed existing(const Listed& listed, const fs::path& file, ImportReport& report) {
  Listed there;
  std::error_code ignored;
  for (std::size_t i = 0; i < listed.images.size(); ++i) {
    if (!fs::is_regular_file(listed.images[i], ignored)) continue;
    there.images.push_back(listed.images[i]);
    there.times_s.push_back(listed.times_s[i]);
  }
  if (there.images.empty()) {
    throw InputError(file.string(), "none of its images is there", "copy the images to it");
  }
  const std::size_t missing = listed.images.size() - there.images.size();
  if (missing > 0) {
    report.notes.push_back(std::to_string(missing) + " of " + std::to_string(listed.images.size()) +
                           " images of " + file.filename().string() + " are not there");
  }
  return there;
}

ImportReport import_listed(const DriveImport& options, const Listed& listed,
                           const std::string& label, ImportReport report) {
  ImageDrive drive;
  drive.label = label;
  drive.images = listed.images;
  drive.times_s = options.fps ? stamps_of_fps(*options.fps, listed.images.size()) : listed.times_s;
  drive.camera = given_calibration(options, drive.images.front(), report);
  drive.T_vehicle_cam = mount_at(options.mount, height_above_road(options, report));
  drive.convention = options.convention;
  report.log = options.log;
  write_drive(drive, options.log, options.copy_images, report);
  return report;
}

}  // namespace

ImportReport import_euroc(const DriveImport& options) {
  require_source_folder(options.source);
  const bool above = fs::is_directory(options.source / "mav0");
  const fs::path rig = above ? options.source / "mav0" : options.source;
  const fs::path camera = rig / "cam0";
  ImportReport report;
  const Listed listed =
      existing(read_list(camera / "data.csv", camera / "data"), camera / "data.csv", report);
  DriveImport own = options;
  if (own.calibration.empty()) own.calibration = (camera / "sensor.yaml").string();
  for (const char* other : {"cam1", "imu0"}) {
    if (!fs::exists(rig / other)) continue;
    report.notes.push_back(std::string(other) + (other[0] == 'c'
                                                     ? " is left out: cam0 is imported"
                                                     : " is left out: its axes are not the "
                                                       "vehicle's"));
  }
  return import_listed(own, listed, "cam0", std::move(report));
}

ImportReport import_tum(const DriveImport& options) {
  require_source_folder(options.source);
  const fs::path list = options.source / "rgb.txt";
  ImportReport report;
  const Listed listed = existing(read_list(list, options.source), list, report);
  if (fs::exists(options.source / "groundtruth.txt")) {
    report.notes.emplace_back("groundtruth.txt is left out: give it to `oneac eval`");
  }
  return import_listed(options, listed, "rgb", std::move(report));
}

}  // namespace oneac
