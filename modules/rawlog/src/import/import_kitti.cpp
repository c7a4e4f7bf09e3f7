#include "oneac/rawlog/import_kitti.h"

#include "import/image_drive.h"
#include "import/import_images.h"
#include "import/number_table.h"
#include "import/stamps.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/input_file.h"
#include "oneac/base/median.h"
#include "oneac/base/number_text.h"
#include "oneac/geometry/camera_height.h"
#include "oneac/geometry/camera_plausibility.h"
#include "oneac/rawlog/calibration.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace oneac {
namespace {

namespace fs = std::filesystem;

constexpr double kRate_hz = 10.0;  // KITTI's, where times.txt is missing
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
                     "convert them to PNG, JPEG, BMP, PGM, PPM, TIFF or WebP");
  }
  throw InputError(
      source.string(),
      "no images (png, jpg, bmp, pgm, ppm, tif, webp) in image_0, image_l, image_2 or images in it",
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

/// image_1 beside image_0, image_3 beside image_2.
std::optional<RightImages> find_right(const KittiImport& options, const Sequence& sequence,
                                      ImportReport& report) {
  const bool grey = sequence.label == "image_0", colour = sequence.label == "image_2";
  if (!grey && !colour) return std::nullopt;
  const fs::path folder = options.source / (grey ? "image_1" : "image_3");
  const std::string left = grey ? "P0" : "P2", right = grey ? "P1" : "P3";
  if (!options.calibration.empty()) {
    return given_right_images(sequence.images, folder, options.calibration, left, right, report);
  }
  return kitti_right_images(sequence.images, folder, options.source / "calib.txt", left, right,
                            report);
}

std::vector<double> find_times(const fs::path& source, const Sequence& sequence,
                               ImportReport& report) {
  const fs::path file = source / "times.txt";
  if (!fs::exists(file)) {
    report.notes.emplace_back("no times.txt: the images are stamped at 10 Hz");
    return stamps_at_rate(sequence.images.size(), kRate_hz);
  }
  return stamps_from_table(file, sequence.images, report);
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream stream = open_input(file, "put the dataset's file there");
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

/// @throws InputError naming the first row that is no pose, or one that no reader takes
void require_poses(const std::vector<std::vector<double>>& table, const fs::path& file) {
  constexpr double kOrthonormal = 1e-3, kFarthest = 1e15;  // as when a reference is read
  for (std::size_t row = 0; row < table.size(); ++row) {
    if (table[row].size() != kPoseColumns) {
      throw InputError(file.string() + ": row " + std::to_string(row + 1),
                       "holds " + std::to_string(table[row].size()) + " numbers, a pose is 12",
                       "give the poses.txt of this sequence, or take it away");
    }
    const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> T(table[row].data());
    const Eigen::Matrix3d R = T.leftCols<3>();
    if (!(T.col(3).cwiseAbs().maxCoeff() < kFarthest)) {
      throw InputError(file.string() + ": row " + std::to_string(row + 1),
                       "lies 1e15 m away, or more",
                       "give the poses.txt of this sequence, or take it away");
    }
    const Eigen::Matrix3d off = R * R.transpose() - Eigen::Matrix3d::Identity();
    if (off.cwiseAbs().maxCoeff() < kOrthonormal && R.determinant() > 0.0) continue;
    throw InputError(file.string() + ": row " + std::to_string(row + 1), "is no rotation",
                     "give the poses.txt of this sequence, or take it away");
  }
}

/// In the sequence's folder, or where KITTI has them: sequences/03 and poses/03.txt.
fs::path find_poses(const fs::path& source) {
  std::error_code ignored;
  fs::path own = source / "poses.txt";
  if (fs::exists(own, ignored)) return own;
  const fs::path folder = fs::canonical(source, ignored);
  const fs::path kittis =
      folder.parent_path().parent_path() / "poses" / (folder.filename().string() + ".txt");
  const bool there = folder.parent_path().filename() == "sequences" && fs::exists(kittis, ignored);
  return there ? kittis : fs::path();
}

/// The poses of these images, to be written as they stand; empty where there are none.
std::string poses_of(const fs::path& source, const Sequence& sequence, ImportReport& report) {
  const fs::path file = find_poses(source);
  if (file.empty()) return "";
  require_poses(read_number_table(file, kPoseColumns), file);  // found here, not when used
  const std::vector<std::string> lines = lines_of(file);
  const auto rows = rows_of(sequence.images, lines.size());
  if (rows.empty()) {
    report.notes.push_back(file.filename().string() +
                           " is left out: " + counts(lines.size(), sequence.images.size()));
    return "";
  }
  std::string text;
  for (const std::size_t row : rows) text += lines[row] + '\n';
  return text;
}

/// Where they are written, which can be a file. Those beside an earlier log are replaced with it;
/// others are somebody's own. @throws InputError
fs::path place_of_poses(const fs::path& log) {
  fs::path file = log.parent_path() / (log.stem().string() + "_poses.txt");
  std::string fault = fault_of_place(file);
  if (fault.empty() && fs::exists(file) && !fs::exists(log)) fault = "is there without its log";
  if (fault.empty()) return file;
  throw InputError(file.string(), fault + ", where the poses are to be written",
                   "take it away, or give another name with -o");
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
    require_camera_height(*options.camera_height_m);
    return *options.camera_height_m;
  }
  if (is_kittis(camera)) {
    report.notes.emplace_back(
        "size and focal length are KITTI's: its camera height of 1.65 m is "
        "taken, give another with --camera-height");
    return kKittiHeight_m;
  }
  report.notes.emplace_back(
      "the camera's height is not known, and nothing will be in metres by it: give "
      "--camera-height");
  return 0.0;
}

}  // namespace

ImportReport import_kitti(const KittiImport& options) {
  const Sequence sequence = find_images(options.source);
  ImportReport report;
  report.log = options.log;
  ImageDrive drive;
  drive.label = sequence.label;
  drive.images = sequence.images;
  drive.camera = options.calibration.empty()
                     ? find_calibration(options.source, sequence)
                     : calibration_for(options.calibration, sequence.images.front(), report);
  drive.T_vehicle_cam = mount_at(options.mount, height_of(options, drive.camera, report));
  drive.convention = options.convention;
  note_order(sequence.images, report);
  drive.times_s = options.fps ? stamps_of_fps(*options.fps, sequence.images.size())
                              : find_times(options.source, sequence, report);
  drive.right = find_right(options, sequence, report);
  require_writable_folder(options.log.has_parent_path() ? options.log.parent_path() : ".");
  const std::string poses = poses_of(options.source, sequence, report);
  if (!poses.empty()) report.poses = place_of_poses(options.log);
  write_drive(drive, options.log, options.copy_images, report);  // not where poses are none
  if (!poses.empty()) write_file_atomically(report.poses, poses);
  return report;
}

}  // namespace oneac
