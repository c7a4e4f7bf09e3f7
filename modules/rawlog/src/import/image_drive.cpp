#include "import/image_drive.h"

#include "import/import_images.h"
#include "import/stamps.h"
#include "import/timed_record.h"

#include "oneac/base/error.h"
#include "oneac/base/number_text.h"
#include "oneac/geometry/camera_height.h"
#include "oneac/geometry/camera_plausibility.h"
#include "oneac/rawlog/calibration.h"
#include "oneac/rawlog/log_neighbours.h"
#include "oneac/rawlog/rawlog_writer.h"

namespace oneac {
namespace {

namespace fs = std::filesystem;

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

class DriveWriter {
 public:
  DriveWriter(const ImageDrive& drive, const fs::path& log, bool copy_images)
      : drive_(drive), log_(log), references_(log, copy_images) {}

  void run(ImportReport& report) {
    std::vector<TimedRecord> pending;
    for (std::size_t i = 0; i < drive_.images.size(); ++i) {
      pending.push_back({drive_.times_s[i], [this, i](RawlogWriter& log) { write_image(i, log); }});
    }
    for (const GpsRecord& fix : drive_.gps) {
      pending.push_back({fix.time_s, [&fix](RawlogWriter& log) { log.write(fix); }});
    }
    for (const ImuRecord& sample : drive_.imu) {
      pending.push_back({sample.time_s, [&sample](RawlogWriter& log) { log.write(sample); }});
    }
    for (const OdometryRecord& wheels : drive_.wheels) {
      pending.push_back({wheels.time_s, [&wheels](RawlogWriter& log) { log.write(wheels); }});
    }
    write_in_order(std::move(pending), log_);
    if (drive_.made) drive_.made->keep();
    references_.keep();
    log_.close();
    report.observations = drive_.images.size();
    report.images = drive_.images.size() + rights_;
    report.gps = drive_.gps.size();
    report.imu = drive_.imu.size();
    report.wheels = drive_.wheels.size();
  }

 private:
  [[nodiscard]] std::string reference(const fs::path& image, const std::string& prefix = "") {
    return drive_.made ? drive_.made->kept_path(image) : references_.refer_to(image, prefix);
  }

  void write_image(std::size_t i, RawlogWriter& log) {
    if (drive_.right) return write_pair(i, log);
    log.write(ImageRecord{drive_.times_s[i], drive_.label, drive_.camera, drive_.T_vehicle_cam,
                          drive_.convention, reference(drive_.images[i])});
  }

  void write_pair(std::size_t i, RawlogWriter& log) {
    StereoRecord record;
    record.time_s = drive_.times_s[i];
    record.label = drive_.label;
    record.left = record.right = drive_.camera;  // rectified together
    record.T_vehicle_left = drive_.T_vehicle_cam;
    record.T_left_right.translation().x() = drive_.right->baseline_m;
    record.convention = drive_.convention;
    record.left_file = reference(drive_.images[i], "left_");
    const fs::path& right = drive_.right->images[i];
    if (!right.empty()) record.right_file = reference(right, "right_");
    rights_ += right.empty() ? 0U : 1U;
    log.write(record);
  }

  const ImageDrive& drive_;
  RawlogWriter log_;
  ImageReferences references_;
  std::size_t rights_ = 0;
};

}  // namespace

void write_drive(const ImageDrive& drive, const fs::path& log, bool copy_images,
                 ImportReport& report) {
  DriveWriter(drive, log, copy_images).run(report);
  note_strange_poses(log, report);
}

void note_strange_poses(const fs::path& log, ImportReport& report) {
  const std::string poses = poses_beside(log);
  if (poses.empty() || !report.poses.empty()) return;
  report.notes.push_back(poses +
                         " lies beside the log and is not of this import: `run` compares with it; "
                         "take it away if it is of another drive");
}

PinholeCamera calibration_for(const std::string& file_and_section, const fs::path& image,
                              ImportReport& report) {
  return fitted_to(image, load_calibration(file_and_section, "left"), file_and_section, report);
}

PinholeCamera fitted_to(const fs::path& image, PinholeCamera camera, const std::string& where,
                        ImportReport& report) {
  const std::string impossible = impossible_camera(camera);
  if (!impossible.empty()) {
    throw InputError(where, impossible, "give the calibration of these images");
  }
  const auto [width, height] = image_size(image);
  if (camera.width == 0 || camera.height == 0) {
    camera.width = width;
    camera.height = height;
  }
  if (camera.width == width && camera.height == height) return camera;
  const std::string sizes = "is for " + size_text(camera.width, camera.height) +
                            ", the images are " + size_text(width, height);
  const auto scaled = resized(camera, width, height);
  if (!scaled) {
    throw InputError(where, sizes, "give the calibration of these images");
  }
  report.notes.push_back("the calibration " + sizes +
                         ": it was scaled to them; give their own if they were cropped");
  return *scaled;
}

PinholeCamera given_calibration(const DriveImport& options, const fs::path& image,
                                ImportReport& report) {
  if (!options.calibration.empty()) return calibration_for(options.calibration, image, report);
  throw InputError(options.source.string(), "nothing tells the calibration of its camera",
                   "give it with --calibration FILE[:SECTION]");
}

void require_camera_height(double height_m) {
  if (CameraHeight::is_plausible(height_m)) return;
  throw InputError("--camera-height " + exact_text(height_m),
                   "no camera of a vehicle is that far above the road",
                   "give metres, from " + exact_text(CameraHeight::kLowest) + " to " +
                       exact_text(CameraHeight::kHighest));
}

double height_above_road(const DriveImport& options, ImportReport& report) {
  if (options.camera_height_m) {
    require_camera_height(*options.camera_height_m);
    return *options.camera_height_m;
  }
  report.notes.emplace_back(
      "the camera's height is not known, and nothing will be in metres by it: give "
      "--camera-height");
  return 0.0;
}

Eigen::Isometry3d mount_at(const MountAngles& mount, double height_m) {
  require_mount(mount);
  Eigen::Isometry3d T_vehicle_cam = Eigen::Isometry3d::Identity();
  T_vehicle_cam.linear() = mount_rotation(mount);
  T_vehicle_cam.translation().z() = height_m;
  return T_vehicle_cam;
}

void note_order(const std::vector<fs::path>& images, ImportReport& report) {
  if (!is_reordered(images)) return;
  report.notes.emplace_back("the images are ordered by the numbers in their names: " +
                            images.front().filename().string() + " to " +
                            images.back().filename().string());
}

std::vector<double> stamps_of_fps(double fps, std::size_t images) {
  constexpr double kSlowest = 0.5, kFastest = 250.0;  // [1/s] as the spacings of a times.txt
  if (fps >= kSlowest && fps <= kFastest) return stamps_at_rate(images, fps);
  throw InputError("--fps " + exact_text(fps), "no camera of a drive has this rate",
                   "give images per second, from 0.5 to 250");
}

bool is_baseline(double baseline_m) {
  constexpr double kShortest_m = 0.05, kLongest_m = 3.0;  // a vehicle is no wider
  return baseline_m >= kShortest_m && baseline_m <= kLongest_m;
}

}  // namespace oneac
