#include "oneac/rawlog/drive_recorder.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/ordered_pipeline.h"
#include "oneac/rawlog/rawlog_writer.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace oneac {
namespace {

namespace fs = std::filesystem;

constexpr int kJpegQuality = 95;  // blocks stay below the noise of the images
constexpr const char* kCameraLabel = "CAMERA1";

void write_jpeg(const fs::path& path, const GreyImage& image) {
  const ImageView view = image.view();
  // OpenCV has no read-only matrix header; imencode only reads.
  const cv::Mat pixels(view.height, view.width, CV_8UC1, const_cast<std::uint8_t*>(view.data));
  std::vector<unsigned char> encoded;
  cv::imencode(".jpg", pixels, encoded, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  write_file_atomically(
      path, std::string_view(reinterpret_cast<const char*>(encoded.data()), encoded.size()));
}

/// "img_CAMERA1_1261229980.100000_left.jpg": microseconds, as the Málaga dataset names its images.
std::string image_name(double time_s, const char* suffix) {
  std::array<char, 80> name{};
  std::snprintf(name.data(), name.size(), "img_%s_%.6f%s.jpg", kCameraLabel, time_s, suffix);
  return name.data();
}

void check(const DriveRecording& drive) {
  if (drive.times_s.size() == drive.T_world_cam.size()) return;
  throw std::invalid_argument("DriveRecording.T_world_cam has " +
                              std::to_string(drive.T_world_cam.size()) + " poses, must have " +
                              std::to_string(drive.times_s.size()));
}

class DriveWriter {
 public:
  DriveWriter(const DriveRecording& drive, const fs::path& folder)
      : drive_(drive),
        files_{folder / "simulated.rawlog", folder / "Images", folder / "poses.txt"},
        stereo_(drive.baseline_m > 0.0) {
    require_writable_folder(files_.images);
    log_.emplace(files_.log);
  }

  RecordedDrive run() {
    std::size_t next = 0;
    ordered_pipeline(
        [&]() -> std::optional<std::size_t> {
          return next < drive_.times_s.size() ? std::optional(next++) : std::nullopt;
        },
        [this](std::size_t i) { return write_images(i); },
        [this](std::size_t i) { return write_records(i); }, drive_.threads);
    const bool whole = written_ == drive_.times_s.size();
    if (whole) write_sensors_until(std::numeric_limits<double>::max());
    write_poses();
    log_->close();
    return files_;
  }

 private:
  std::size_t write_images(std::size_t i) const {
    const DriveImages images = drive_.images(i);
    write_jpeg(files_.images / left_name(i), images.left);
    if (stereo_) write_jpeg(files_.images / right_name(i), images.right);
    return i;
  }

  bool write_records(std::size_t i) {
    write_sensors_until(drive_.times_s[i]);
    if (stereo_) {
      write_stereo(i);
    } else {
      log_->write(ImageRecord{time(i), kCameraLabel, drive_.camera, drive_.T_vehicle_cam,
                              drive_.convention, left_name(i)});
    }
    written_ = i + 1;
    return !drive_.keep_going || drive_.keep_going(written_);
  }

  void write_stereo(std::size_t i) {
    StereoRecord record;
    record.time_s = time(i);
    record.label = kCameraLabel;
    record.left = record.right = drive_.camera;
    record.T_vehicle_left = drive_.T_vehicle_cam;
    record.T_left_right.translation().x() = drive_.baseline_m;
    record.convention = drive_.convention;
    record.left_file = left_name(i);
    record.right_file = right_name(i);
    log_->write(record);
  }

  void write_sensors_until(double time_s) {
    for (;;) {
      const double gps_s = time_of(drive_.gps, next_gps_);
      const double imu_s = time_of(drive_.imu, next_imu_);
      const double wheels_s = time_of(drive_.wheels, next_wheels_);
      if (std::min({gps_s, imu_s, wheels_s}) > time_s) return;
      if (gps_s <= std::min(imu_s, wheels_s)) {
        write_sensor(drive_.gps[next_gps_++]);
      } else if (wheels_s < imu_s) {
        write_sensor(drive_.wheels[next_wheels_++]);
      } else {
        write_sensor(drive_.imu[next_imu_++]);
      }
    }
  }

  template <class Record>
  static double time_of(const std::vector<Record>& records, std::size_t i) {
    return i < records.size() ? records[i].time_s : std::numeric_limits<double>::infinity();
  }

  template <class Record>
  void write_sensor(Record record) {
    record.time_s += drive_.epoch_s;
    log_->write(record);
  }

  void write_poses() const {
    std::string rows;
    for (std::size_t i = 0; i < written_; ++i) {
      const Eigen::Isometry3d T = drive_.T_world_cam.front().inverse() * drive_.T_world_cam[i];
      for (int k = 0; k < 12; ++k) {
        std::array<char, 32> number{};
        std::snprintf(number.data(), number.size(), "%.9e", T(k / 4, k % 4));
        rows += number.data();
        rows += k == 11 ? '\n' : ' ';
      }
    }
    write_file_atomically(files_.poses, rows);
  }

  [[nodiscard]] double time(std::size_t i) const { return drive_.epoch_s + drive_.times_s[i]; }
  [[nodiscard]] std::string left_name(std::size_t i) const {
    return image_name(time(i), stereo_ ? "_left" : "");
  }
  [[nodiscard]] std::string right_name(std::size_t i) const {
    return image_name(time(i), "_right");
  }

  const DriveRecording& drive_;
  RecordedDrive files_;
  bool stereo_;
  std::optional<RawlogWriter> log_;
  std::size_t written_ = 0;  ///< frames
  std::size_t next_gps_ = 0;
  std::size_t next_imu_ = 0;
  std::size_t next_wheels_ = 0;
};

}  // namespace

RecordedDrive record_drive(const DriveRecording& drive, const fs::path& folder) {
  check(drive);
  return DriveWriter(drive, folder).run();
}

}  // namespace oneac
