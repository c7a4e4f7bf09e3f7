#include "import/malaga_text.h"

#include "import/number_table.h"
#include "read/calibration_file.h"

#include "oneac/base/error.h"
#include "oneac/geometry/angles.h"
#include "oneac/rawlog/calibration.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

namespace oneac {
namespace {

namespace fs = std::filesystem;

constexpr double kKnot = 1852.0 / 3600.0;       // [m/s]
constexpr const char* kGpsLabel = "GPS_DELUO";  // as in the dataset's own logs
constexpr const char* kImuLabel = "XSensMTi";
const Eigen::Vector3d kAntenna(0.155, 0.069, 0.004);  // [m] as in the dataset's own logs

// Columns of *_GPS.txt
enum GpsColumn : std::size_t {
  kGpsTime,
  kLat,
  kLon,
  kAlt,
  kFix,
  kSatellites,
  kSpeed,
  kCourse,
  kGpsColumns
};
// Columns of *_IMU.txt
enum ImuColumn : std::size_t {
  kImuTime,
  kAccX,
  kAccY,
  kAccZ,
  kYawVel,
  kPitchVel,
  kRollVel,
  kImuColumns
};

std::vector<fs::path> calibration_files(const fs::path& source) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(source, ignored)) {
    const std::string name = entry.path().filename().string();
    const bool named = name.rfind("camera_params", 0) == 0 && entry.path().extension() == ".txt";
    if (named && entry.is_regular_file(ignored)) files.push_back(entry.path());
  }
  const auto is_raw = [](const fs::path& file) {
    return file.filename().string().find("rectified") == std::string::npos;
  };
  std::sort(files.begin(), files.end(), [&](const fs::path& a, const fs::path& b) {
    return std::pair(is_raw(a), a) < std::pair(is_raw(b), b);
  });
  return files;
}

std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> values;
  const char* at = text.data();
  const char* end = at + text.size();
  while (at < end) {
    double value = 0.0;
    const auto result = std::from_chars(at, end, value);
    if (result.ec == std::errc()) values.push_back(value);
    at = result.ec == std::errc() ? result.ptr : at + 1;
  }
  return values;
}

void read_right_pose(const fs::path& file, StereoCalibration& calibration) {
  const CalibrationFile sections = read_calibration_file(file);
  constexpr std::size_t kPoseNumbers = 7;  // x y z, then the quaternion qr qx qy qz
  for (const auto& [name, entries] : sections.sections) {
    const auto pose = entries.find("pose_quaternion");
    if (name.find("LEFT2RIGHT") == std::string::npos || pose == entries.end()) continue;
    const std::vector<double> p = numbers_in(pose->second);
    if (p.size() != kPoseNumbers) continue;
    const Eigen::Quaterniond q(p[3], p[4], p[5], p[6]);
    if (q.norm() == 0.0) continue;
    calibration.T_left_right.linear() = q.normalized().toRotationMatrix();
    calibration.T_left_right.translation() << p[0], p[1], p[2];
    calibration.has_pose = true;
  }
}

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

bool all_zero(const std::vector<std::vector<double>>& rows, std::size_t column) {
  return std::all_of(rows.begin(), rows.end(),
                     [column](const auto& row) { return row[column] == 0.0; });
}

void require_radians(const fs::path& file, const std::vector<double>& row) {
  if (std::abs(row[kLat]) <= M_PI / 2 && std::abs(row[kLon]) <= M_PI) return;
  throw InputError(file.string(), "latitude or longitude beyond the range of radians",
                   "give the *_GPS.txt of the dataset, whose angles are in radians");
}

}  // namespace

StereoCalibration find_malaga_calibration(const fs::path& source, int width, int height) {
  std::string seen;
  for (const fs::path& file : calibration_files(source)) {
    StereoCalibration calibration;
    calibration.file = file.filename().string();
    calibration.left = load_calibration(file.string(), "left");
    calibration.right = load_calibration(file.string(), "right");
    const auto fits = [&](const PinholeCamera& c) {
      return c.width == width && c.height == height;
    };
    if (fits(calibration.left) && fits(calibration.right)) {
      read_right_pose(file, calibration);
      return calibration;
    }
    seen += (seen.empty() ? "; there are " : ", ") + calibration.file + " (" +
            size_text(calibration.left.width, calibration.left.height) + ")";
  }
  throw InputError(source.string(),
                   "no camera_params_*.txt for images of " + size_text(width, height) + seen,
                   "put the camera parameters that belong to the images there");
}

std::optional<fs::path> find_by_ending(const fs::path& folder, const std::string& ending) {
  std::optional<fs::path> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    const bool ends = name.size() >= ending.size() &&
                      name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
    if (ends && (!found || entry.path() < *found)) found = entry.path();
  }
  return found;
}

std::vector<GpsRecord> read_malaga_gps(const fs::path& file) {
  const auto rows = read_number_table(file, kGpsColumns);
  const bool moving = !all_zero(rows, kSpeed) || !all_zero(rows, kCourse);
  std::vector<GpsRecord> records;
  for (const auto& row : rows) {
    require_radians(file, row);
    GpsRecord record;
    record.time_s = row[kGpsTime];
    record.label = kGpsLabel;
    record.antenna = kAntenna;
    record.position = {row[kLat] / kDegree, row[kLon] / kDegree, row[kAlt]};
    record.fix_quality = static_cast<int>(std::clamp(row[kFix], 0.0, 8.0));
    record.satellites = static_cast<int>(std::clamp(row[kSatellites], 0.0, 255.0));
    // MRPT's text export, which the file is, keeps RMC's units: knots and degrees.
    if (moving) record.velocity = GroundVelocity{row[kSpeed] * kKnot, row[kCourse]};
    records.push_back(record);
  }
  return records;
}

std::vector<ImuRecord> read_malaga_imu(const fs::path& file) {
  std::vector<ImuRecord> records;
  for (const auto& row : read_number_table(file, kImuColumns)) {
    ImuRecord record;
    record.time_s = row[kImuTime];
    record.label = kImuLabel;
    record.acceleration << row[kAccX], row[kAccY], row[kAccZ];
    record.angular_rate << row[kRollVel], row[kPitchVel], row[kYawVel];
    records.push_back(record);
  }
  return records;
}

}  // namespace oneac
