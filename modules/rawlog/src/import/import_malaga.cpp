#include "oneac/rawlog/import_malaga.h"

#include "import/image_drive.h"
#include "import/import_images.h"
#include "import/malaga_images.h"
#include "import/malaga_text.h"
#include "import/timed_record.h"

#include "oneac/geometry/camera_frame.h"
#include "oneac/geometry/levelling.h"
#include "oneac/rawlog/rawlog_writer.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace oneac {
namespace {

namespace fs = std::filesystem;

constexpr double kTilt = 8.2 * M_PI / 180.0;  // upwards; as in the dataset's own logs

/// The left camera on the vehicle, as in the dataset's own logs where nobody says otherwise.
Eigen::Isometry3d malaga_mount(const std::optional<MountAngles>& given) {
  Eigen::Isometry3d T = CameraFrame::forward_looking_mount();
  T.linear() = given ? mount_rotation(*given) : T.linear() * levelling_rotation({kTilt, 0.0});
  T.translation() << 0.785, 0.0, 0.273;
  return T;
}

class MalagaImporter {
 public:
  explicit MalagaImporter(const MalagaImport& options) : options_(options) {
    report_.log = options.log;
  }

  ImportReport run() {
    const std::vector<MalagaPair> pairs = find_malaga_pairs(options_.source);
    const auto& first = pairs.front();
    const auto size = image_size(first.left.empty() ? first.right : first.left);
    calibration_ = find_malaga_calibration(options_.source, size.first, size.second);
    add_gps();
    add_imu();
    RawlogWriter log(options_.log);
    ImageReferences references(options_.log, options_.copy_images);
    for (const MalagaPair& pair : pairs) add_pair(pair, references);
    note_what_is_missing(pairs);
    write_in_order(std::move(pending_), log);
    references.keep();
    log.close();
    note_strange_poses(options_.log, report_);
    return report_;
  }

 private:
  template <class Record>
  void add(const Record& record) {
    pending_.push_back({record.time_s, [record](RawlogWriter& log) { log.write(record); }});
  }

  void add_gps() {
    const auto file = find_by_ending(options_.source, "_GPS.txt");
    if (!file) {
      report_.notes.emplace_back("no *_GPS.txt: the log is without GPS");
      return;
    }
    const std::vector<GpsRecord> records = read_malaga_gps(*file);
    report_.gps = records.size();
    for (const GpsRecord& record : records) add(record);
    const bool moving = !records.empty() && records.front().velocity.has_value();
    if (!moving) {
      report_.notes.push_back(file->filename().string() +
                              " holds no speed or course: positions (GGA) only");
    }
  }

  void add_imu() {
    const auto file = find_by_ending(options_.source, "_IMU.txt");
    if (!file) {
      report_.notes.emplace_back("no *_IMU.txt: the log is without IMU");
      return;
    }
    const std::vector<ImuRecord> records = read_malaga_imu(*file);
    report_.imu = records.size();
    for (const ImuRecord& record : records) add(record);
  }

  void add_pair(const MalagaPair& pair, ImageReferences& references) {
    StereoRecord record;
    record.time_s = pair.time_s;
    record.label = pair.label;
    record.left = calibration_.left;
    record.right = calibration_.right;
    record.T_vehicle_left = malaga_mount(options_.mount);
    record.T_left_right = calibration_.T_left_right;
    record.convention = options_.convention;
    // A stereo observation always has a left image: a missing one is named as it would be called.
    record.left_file = pair.left.empty() ? missing_left(pair) : references.refer_to(pair.left);
    if (!pair.right.empty()) record.right_file = references.refer_to(pair.right);
    report_.images += (pair.left.empty() ? 0U : 1U) + (pair.right.empty() ? 0U : 1U);
    ++report_.observations;
    add(record);
  }

  static std::string missing_left(const MalagaPair& pair) {
    return "img_" + pair.label + "_" + pair.time_text + "_left" + pair.right.extension().string();
  }

  void note_what_is_missing(const std::vector<MalagaPair>& pairs) {
    const auto lefts = std::count_if(pairs.begin(), pairs.end(),
                                     [](const MalagaPair& pair) { return !pair.left.empty(); });
    const auto rights = std::count_if(pairs.begin(), pairs.end(),
                                      [](const MalagaPair& pair) { return !pair.right.empty(); });
    if (lefts != rights) {
      report_.notes.push_back(std::to_string(lefts) + " left and " + std::to_string(rights) +
                              " right images");
    }
    report_.notes.push_back("calibration of " + calibration_.file);
    if (!calibration_.has_pose) {
      report_.notes.push_back(
          calibration_.file +
          " has no left-to-right pose: the right camera is at the left one's place");
    }
  }

  const MalagaImport& options_;
  ImportReport report_;
  StereoCalibration calibration_;
  std::vector<TimedRecord> pending_;
};

}  // namespace

ImportReport import_malaga(const MalagaImport& options) {
  if (options.mount) require_mount(*options.mount);
  return MalagaImporter(options).run();
}

}  // namespace oneac
