#include "import/image_drive.h"
#include "import/import_images.h"
#include "import/number_table.h"
#include "import/stamps.h"

#include "oneac/base/error.h"
#include "oneac/rawlog/calibration.h"

#include <array>
#include <cmath>

namespace oneac {
namespace {

namespace fs = std::filesystem;

/// The cameras of KITTI's car: grey and colour pairs.
struct RawPair {
  const char *left, *right, *left_id, *right_id;
};
constexpr std::array<RawPair, 2> kPairs{
    {{"image_00", "image_01", "00", "01"}, {"image_02", "image_03", "02", "03"}}};

const RawPair& pair_of(const fs::path& source) {
  for (const RawPair& pair : kPairs) {
    if (!list_images(source / pair.left / "data").empty()) return pair;
  }
  throw InputError(source.string(), "no images in image_00/data or image_02/data in it",
                   "give the folder of one drive, such as 2011_09_26_drive_0001_sync");
}

/// Beside the drive's folders or, as KITTI unpacks, in the folder of its day.
fs::path find_calibration(const fs::path& source) {
  const fs::path name = "calib_cam_to_cam.txt";
  std::error_code ignored;
  const fs::path day = fs::canonical(source, ignored).parent_path();
  for (const fs::path& folder : {source, day}) {
    if (fs::exists(folder / name, ignored)) return folder / name;
  }
  throw InputError((source / name).string(), "no such file, nor in the folder above",
                   "put the calibration of the drive's day there, or give --calibration");
}

/// The rectified camera, unless the images have the size of the raw one and not its own.
std::string section_for(const fs::path& file, const RawPair& pair, const fs::path& image) {
  const std::string rectified = file.string() + ":P_rect_" + pair.left_id;
  const std::string raw = file.string() + ":K_" + pair.left_id;
  const auto [width, height] = image_size(image);
  const auto is_of = [&, w = width, h = height](const std::string& section) {
    const PinholeCamera camera = load_calibration(section, "");
    return camera.width == w && camera.height == h;
  };
  return is_of(rectified) || !is_of(raw) ? rectified : raw;
}

template <class Row>
std::vector<Row> picked(const std::vector<Row>& rows, const std::vector<std::size_t>& chosen) {
  std::vector<Row> some;
  some.reserve(chosen.size());
  for (const std::size_t row : chosen) some.push_back(rows[row]);
  return some;
}

std::vector<double> times_of(const DriveImport& options, const fs::path& folder,
                             const std::vector<fs::path>& images) {
  if (options.fps) return stamps_of_fps(*options.fps, images.size());
  const fs::path file = folder / "timestamps.txt";
  const std::vector<double> all = read_date_stamps(file);
  const auto rows = rows_of(images, all.size());
  if (rows.empty()) {
    throw InputError(file.string(), counts(all.size(), images.size()),
                     "give the timestamps.txt of this drive, or --fps");
  }
  std::vector<double> times = picked(all, rows);
  require_increasing(times, images, file);
  return times;
}

/// Columns of KITTI's oxts packets, see their dataformat.txt.
enum Oxts : std::size_t {
  kLatitude = 0,
  kLongitude = 1,
  kAltitude = 2,
  kNorth = 6,
  kEast = 7,
  kForwardAcceleration = 11,  // then left, up
  kRollRate = 17,             // then pitch, yaw
  kColumns = 25
};

void add_oxts_row(const std::vector<double>& row, double time_s, ImageDrive& drive) {
  GpsRecord fix;
  fix.time_s = time_s;
  fix.label = "oxts";
  fix.position = {row[kLatitude], row[kLongitude], row[kAltitude]};
  const double speed = std::hypot(row[kNorth], row[kEast]);
  const double course = std::atan2(row[kEast], row[kNorth]) * 180.0 / M_PI;
  fix.velocity = GroundVelocity{speed, course < 0.0 ? course + 360.0 : course};
  drive.gps.push_back(fix);
  ImuRecord sample;
  sample.time_s = time_s;
  sample.label = "oxts";
  sample.acceleration = Eigen::Vector3d::Map(&row[kForwardAcceleration]);
  sample.angular_rate = Eigen::Vector3d::Map(&row[kRollRate]);
  drive.imu.push_back(sample);
}

void require_on_earth(const std::vector<double>& row, const fs::path& file) {
  if (std::abs(row[kLatitude]) <= 90.0 && std::abs(row[kLongitude]) <= 180.0) return;
  throw InputError(file.string(), "its latitude or longitude is beyond the range of degrees",
                   "get the file again from its source");
}

void add_oxts(const fs::path& folder, ImageDrive& drive, ImportReport& report) {
  std::error_code ignored;
  if (!fs::is_directory(folder / "data", ignored)) {
    report.notes.emplace_back("no oxts: the log is without GPS and IMU");
    return;
  }
  const std::vector<double> times = read_date_stamps(folder / "timestamps.txt");
  std::size_t missing = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    std::string name = std::to_string(i);
    name.insert(0, name.size() < 10 ? 10 - name.size() : 0, '0');
    const fs::path file = folder / "data" / (name + ".txt");
    if (!fs::exists(file, ignored)) {
      ++missing;
      continue;
    }
    const auto rows = read_number_table(file, kColumns);
    if (rows.size() != 1) {
      throw InputError(file.string(), std::to_string(rows.size()) + " rows, expected one",
                       "get the file again from its source");
    }
    require_on_earth(rows.front(), file);
    add_oxts_row(rows.front(), times[i], drive);
  }
  if (missing == 0) return;
  report.notes.push_back(std::to_string(missing) + " of " + std::to_string(times.size()) +
                         " packets of oxts are not there");
}

double height_of(const DriveImport& options, ImportReport& report) {
  if (options.camera_height_m) return height_above_road(options, report);
  report.notes.emplace_back(
      "the layout is that of KITTI's raw data: its camera height of 1.65 m is taken, give another "
      "with --camera-height");
  return kKittiHeight_m;
}

}  // namespace

bool is_kitti_raw(const fs::path& source) {
  std::error_code ignored;
  return fs::is_directory(source / "image_00" / "data", ignored) ||
         fs::is_directory(source / "image_02" / "data", ignored);
}

ImportReport import_kitti_raw(const DriveImport& options) {
  require_source_folder(options.source);
  const RawPair& pair = pair_of(options.source);
  ImportReport report;
  report.log = options.log;
  ImageDrive drive;
  drive.label = pair.left;
  drive.images = list_images(options.source / pair.left / "data");
  const bool given = !options.calibration.empty();
  const fs::path file = given ? fs::path() : find_calibration(options.source);
  const std::string chosen =
      given ? options.calibration : section_for(file, pair, drive.images.front());
  drive.camera = calibration_for(chosen, drive.images.front(), report);
  drive.times_s = times_of(options, options.source / pair.left, drive.images);
  drive.T_vehicle_cam = mount_at(options.mount, height_of(options, report));
  drive.convention = options.convention;
  const fs::path folder = options.source / pair.right / "data";
  const std::string left = std::string("P_rect_") + pair.left_id,
                    right = std::string("P_rect_") + pair.right_id;
  if (given) {
    drive.right =
        given_right_images(drive.images, folder, options.calibration, left, right, report);
  } else if (!drive.camera.is_distorted()) {
    drive.right = kitti_right_images(drive.images, folder, file, left, right, report);
  }
  add_oxts(options.source / "oxts", drive, report);
  write_drive(drive, options.log, options.copy_images, report);
  return report;
}

}  // namespace oneac
