#include "oneac/rawlog/import_kitti.h"

#include "import/import_images.h"
#include "import/number_table.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/median.h"
#include "oneac/base/number_text.h"
#include "oneac/geometry/camera_height.h"
#include "oneac/geometry/camera_plausibility.h"
#include "oneac/rawlog/calibration.h"
#include "oneac/rawlog/rawlog_writer.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace oneac {
namespace {

namespace fs = std::filesystem;

constexpr double kRate_hz = 10.0;          // KITTI's, where times.txt is missing
constexpr double kEpoch_s = 1317016800.0;  // 26 September 2011, when sequence 03 was recorded
constexpr double kUnixTimes_s = 1e8;       // times.txt counts from 0; larger ones are Unix times
constexpr double kHeight_m = 1.65;         // of KITTI's cameras above the road
constexpr std::array<double, 3> kFocals_px{707.0912, 718.856, 721.5377};  // of KITTI's days
constexpr double kSameFocal_px = 0.05;
constexpr std::size_t kPoseColumns = 12;  // rows of [R | t]
constexpr std::array<const char*, 4> kImageFolders{"image_0", "image_l", "image_2", "images"};

struct Sequence {
  std::string label;
  std::vector<fs::path> images;
};

Sequence find_images(const fs::path& source) {
  require_source_folder(source);
  for (const char* folder : kImageFolders) {
    Sequence sequence{folder, list_images(source / folder)};
    if (!sequence.images.empty()) return sequence;
  }
  for (const char* folder : kImageFolders) {
    const std::string foreign = foreign_images(source / folder);
    if (foreign.empty()) continue;
    throw InputError((source / folder).string(), "its images (" + foreign + ") are not read",
                     "convert them to PNG, JPEG, BMP, PGM or PPM");
  }
  throw InputError(
      source.string(),
      "no images (png, jpg, bmp, pgm, ppm) in image_0, image_l, image_2 or images in it",
      "give the folder of one sequence, such as sequences/03");
}

PinholeCamera find_calibration(const fs::path& source, const Sequence& sequence) {
  const fs::path file = source / "calib.txt";
  if (!fs::exists(file)) {
    throw InputError(file.string(), "no such file",
                     "put the sequence's calib.txt (with the line P0: ...) there");
  }
  const std::string section = sequence.label == "image_2" ? ":P2" : ":P0";
  PinholeCamera camera = load_calibration(file.string() + section, "");
  std::tie(camera.width, camera.height) = image_size(sequence.images.front());
  if (const std::string fault = impossible_camera(camera); !fault.empty()) {
    throw InputError(file.string(), fault, "give the calib.txt of this sequence");
  }
  return camera;
}

std::optional<std::size_t> number_of(const fs::path& image) {
  const std::string stem = image.stem().string();
  std::size_t number = 0;
  const auto result = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  const bool all = result.ec == std::errc() && result.ptr == stem.data() + stem.size();
  return all ? std::optional(number) : std::nullopt;
}

/// Row of a table that belongs to each image; empty when neither numbers nor order fit.
std::vector<std::size_t> rows_of(const std::vector<fs::path>& images, std::size_t rows) {
  std::vector<std::size_t> chosen;
  for (const fs::path& image : images) {
    const auto number = number_of(image);
    if (number && *number < rows) chosen.push_back(*number);
  }
  if (chosen.size() == images.size()) return chosen;
  chosen.clear();
  if (images.size() != rows) return chosen;
  for (std::size_t i = 0; i < rows; ++i) chosen.push_back(i);
  return chosen;
}

std::string counts(std::size_t rows, std::size_t images) {
  return std::to_string(rows) + " rows for " + std::to_string(images) + " images";
}

struct TimeUnit {
  const char* name;
  double seconds;
};
// Steps of a thousand, and spacings of images that differ by less: one unit fits at most.
constexpr std::array<TimeUnit, 4> kUnits{
    {{"seconds", 1.0}, {"milliseconds", 1e-3}, {"microseconds", 1e-6}, {"nanoseconds", 1e-9}}};
constexpr double kClosest_s = 0.004, kWidest_s = 2.0;  // 250 Hz, an image in two seconds
constexpr double kLatest_s = 4.1e9;                    // the year 2100

constexpr const char* kTimesCure =
    "give seconds, or ms, us or ns of a drive with an image every 4 ms to 2 s, or take the file "
    "away for 10 Hz";

/// The unit that makes the median spacing one of images; seconds for a single row.
TimeUnit unit_by_spacing(const std::vector<std::vector<double>>& table, const fs::path& file) {
  std::vector<double> spacings;
  for (std::size_t i = 1; i < table.size(); ++i) {
    spacings.push_back(std::abs(table[i][0] - table[i - 1][0]));
  }
  if (spacings.empty()) return kUnits[0];
  const double median = upper_median(std::move(spacings));
  for (const TimeUnit& unit : kUnits) {
    const double spacing = unit.seconds * median;
    if (spacing >= kClosest_s && spacing <= kWidest_s) return unit;
  }
  throw InputError(file.string(),
                   "rows are " + exact_text(median) +
                       " apart, which is no spacing of images in s, "
                       "ms, us or ns",
                   kTimesCure);
}

/// @throws InputError naming the row of a time that is none since 1970 or the start
TimeUnit unit_of(const std::vector<std::vector<double>>& table, const fs::path& file) {
  const TimeUnit unit = unit_by_spacing(table, file);
  for (std::size_t row = 0; row < table.size(); ++row) {
    const double time_s = unit.seconds * table[row][0];
    if (time_s >= 0.0 && time_s <= kLatest_s) continue;
    throw InputError(
        file.string() + ": row " + std::to_string(row + 1),
        exact_text(table[row][0]) + " " + unit.name + " is no time since the start or 1970",
        kTimesCure);
  }
  return unit;
}

std::vector<double> find_times(const fs::path& source, const Sequence& sequence,
                               ImportReport& report) {
  const fs::path file = source / "times.txt";
  std::vector<double> times;
  if (!fs::exists(file)) {
    report.notes.emplace_back("no times.txt: the images are stamped at 10 Hz");
    for (std::size_t i = 0; i < sequence.images.size(); ++i) {
      times.push_back(kEpoch_s + static_cast<double>(i) / kRate_hz);
    }
    return times;
  }
  const auto table = read_number_table(file, 1);
  const auto rows = rows_of(sequence.images, table.size());
  if (rows.empty()) {
    throw InputError(file.string(), counts(table.size(), sequence.images.size()),
                     "give the times.txt of this sequence, or take it away for 10 Hz");
  }
  const TimeUnit unit = unit_of(table, file);
  if (unit.seconds != 1.0) report.notes.push_back(std::string("times.txt is in ") + unit.name);
  const double epoch = unit.seconds * table.front()[0] < kUnixTimes_s ? kEpoch_s : 0.0;
  for (const std::size_t row : rows) {
    times.push_back(epoch + unit.seconds * table[row][0]);
    if (times.size() < 2 || times.back() > times[times.size() - 2]) continue;
    throw InputError(file.string() + ": row " + std::to_string(row + 1), "time does not increase",
                     "give the times.txt of this sequence, or take it away for 10 Hz");
  }
  return times;
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

/// @throws InputError naming the first row that is no pose
void require_poses(const std::vector<std::vector<double>>& table, const fs::path& file) {
  constexpr double kOrthonormal = 1e-3;  // as when a reference is read
  for (std::size_t row = 0; row < table.size(); ++row) {
    const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> T(table[row].data());
    const Eigen::Matrix3d R = T.leftCols<3>();
    const Eigen::Matrix3d off = R * R.transpose() - Eigen::Matrix3d::Identity();
    if (off.cwiseAbs().maxCoeff() < kOrthonormal && R.determinant() > 0.0) continue;
    throw InputError(file.string() + ": row " + std::to_string(row + 1), "is no rotation",
                     "give the poses.txt of this sequence, or take it away");
  }
}

/// In the sequence's folder, or where KITTI has them: sequences/03 and poses/03.txt.
fs::path find_poses(const fs::path& source) {
  std::error_code ignored;
  const fs::path own = source / "poses.txt";
  if (fs::exists(own, ignored)) return own;
  const fs::path folder = fs::canonical(source, ignored);
  const fs::path kittis =
      folder.parent_path().parent_path() / "poses" / (folder.filename().string() + ".txt");
  const bool there = folder.parent_path().filename() == "sequences" && fs::exists(kittis, ignored);
  return there ? kittis : fs::path();
}

void copy_poses(const fs::path& source, const Sequence& sequence, ImportReport& report) {
  const fs::path file = find_poses(source);
  if (file.empty()) return;
  require_poses(read_number_table(file, kPoseColumns), file);  // found here, not when used
  const std::vector<std::string> lines = lines_of(file);
  const auto rows = rows_of(sequence.images, lines.size());
  if (rows.empty()) {
    report.notes.push_back(file.filename().string() +
                           " is left out: " + counts(lines.size(), sequence.images.size()));
    return;
  }
  std::string text;
  for (const std::size_t row : rows) text += lines[row] + '\n';
  report.poses = report.log.parent_path() / (report.log.stem().string() + "_poses.txt");
  write_file_atomically(report.poses, text);
}

/// Whether the folder is KITTI's own, whose cameras are 1.65 m above the road.
bool is_kittis(const PinholeCamera& camera) {
  const bool size =
      camera.width >= 1224 && camera.width <= 1242 && camera.height >= 370 && camera.height <= 376;
  return size && std::any_of(kFocals_px.begin(), kFocals_px.end(), [&](double focal) {
           return std::abs(camera.fx - focal) < kSameFocal_px;
         });
}

/// [m] above the road; 0: nobody knows.
double height_of(const KittiImport& options, const PinholeCamera& camera, ImportReport& report) {
  if (options.camera_height_m) {
    if (CameraHeight::is_plausible(*options.camera_height_m)) return *options.camera_height_m;
    throw InputError("--camera-height " + exact_text(*options.camera_height_m),
                     "no camera of a vehicle is so high above the road",
                     "give metres, from " + exact_text(CameraHeight::kLowest) + " to " +
                         exact_text(CameraHeight::kHighest));
  }
  if (is_kittis(camera)) {
    report.notes.emplace_back(
        "size and focal length are KITTI's: its camera height of 1.65 m is "
        "taken, give another with --camera-height");
    return kHeight_m;
  }
  report.notes.emplace_back(
      "the camera's height is not known, and nothing will be in metres by it: give "
      "--camera-height");
  return 0.0;
}

void note_order(const Sequence& sequence, ImportReport& report) {
  if (!is_reordered(sequence.images)) return;
  report.notes.emplace_back("the images are ordered by the numbers in their names: " +
                            sequence.images.front().filename().string() + " to " +
                            sequence.images.back().filename().string());
}

}  // namespace

ImportReport import_kitti(const KittiImport& options) {
  const Sequence sequence = find_images(options.source);
  ImportReport report;
  report.log = options.log;
  report.images = report.observations = sequence.images.size();
  ImageRecord record;
  record.label = sequence.label;
  record.camera = find_calibration(options.source, sequence);
  require_mount(options.mount);
  record.T_vehicle_cam.linear() = mount_rotation(options.mount);
  record.T_vehicle_cam.translation().z() = height_of(options, record.camera, report);
  record.convention = options.convention;
  note_order(sequence, report);
  const std::vector<double> times = find_times(options.source, sequence, report);
  RawlogWriter log(options.log);
  const ImageReferences references(options.log, options.copy_images);
  for (std::size_t i = 0; i < times.size(); ++i) {
    record.time_s = times[i];
    record.file = references.refer_to(sequence.images[i]);
    log.write(record);
  }
  copy_poses(options.source, sequence, report);
  log.close();
  return report;
}

}  // namespace oneac
