#include "import/bag/bag_drive.h"

#include "import/bag/stray_stamps.h"
#include "import/gps_order.h"
#include "import/stamps.h"

#include "oneac/base/error.h"
#include "oneac/base/number_text.h"

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

namespace fs = std::filesystem;

constexpr double kNanosecond_s = 1e-9;
constexpr const char* kAnother =
    "cut the bag before it with ROS's `rosbag filter`, or record again";

std::string numbered(std::size_t number) {
  constexpr std::size_t kDigits = 6;
  std::string digits = std::to_string(number);
  digits.insert(0, digits.size() < kDigits ? kDigits - digits.size() : 0, '0');
  return digits;
}

/// A topic's name without what a file's name cannot have.
std::string label_of(const std::string& topic) {
  std::string label = topic.substr(
      topic.find_first_not_of('/') == std::string::npos ? 0 : topic.find_first_not_of('/'));
  std::replace(label.begin(), label.end(), '/', '_');
  return label;
}

template <class Images>
void sort_by_time(Images& images) {
  std::stable_sort(images.begin(), images.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
}

}  // namespace

BagDrive::BagDrive(const RosbagImport& options, BagChoice choice)
    : options_(options),
      choice_(std::move(choice)),
      made_(std::make_shared<MadeImages>(options.log)),
      files_(made_->folder()) {}

std::string BagDrive::where(const BagTopic& topic, const BagMessage& message) const {
  return options_.source.string() + ": " + topic.name + ": message " +
         std::to_string(message.number);
}

void BagDrive::take(const BagTopic& topic, const BagMessage& message) {
  try {
    take_content(topic, message);
  } catch (const BadMessage& bad) {
    throw InputError(where(topic, message), bad.fault, kAnother);
  }
}

void BagDrive::take_content(const BagTopic& topic, const BagMessage& message) {
  const auto with_time = [&](auto stamped, std::vector<decltype(stamped.content)>& records) {
    stamped.content.time_s = time_of(stamped.time_s, topic, message);
    stamped.content.label = label_of(topic.name);
    records.push_back(stamped.content);
  };
  if (topic.name == choice_.images) take_image(topic, message, "", left_);
  if (topic.name == choice_.right) take_image(topic, message, "right_", right_);
  if (topic.name == choice_.camera_info) take_info(topic, message, info_);
  if (topic.name == choice_.right_info) take_info(topic, message, right_info_);
  if (topic.name == choice_.gps) take_fix(topic, message);
  if (topic.name == choice_.imu) with_time(read_ros_imu(message.bytes), imu_);
  if (topic.name == choice_.wheels) with_time(read_ros_odometry(message.bytes), wheels_);
}

double BagDrive::time_of(double header_s, const BagTopic& topic, const BagMessage& message) {
  if (header_s > 0.0) return header_s;
  ++without_time_[topic.name];
  return kNanosecond_s * static_cast<double>(message.received_ns);
}

void BagDrive::require_size(const std::string& topic, const RosImage& image) {
  const std::pair<std::uint32_t, std::uint32_t> size{image.width, image.height};
  const auto [first, is_new] = sizes_.emplace(topic, size);
  if (is_new || first->second == size) return;
  throw BadMessage{"it has " + std::to_string(size.first) + "x" + std::to_string(size.second) +
                   " pixels, the first has " + std::to_string(first->second.first) + "x" +
                   std::to_string(first->second.second)};
}

BagDrive::BagImage BagDrive::image_of(double header_s, fs::path file, const BagTopic& topic,
                                      const BagMessage& message) {
  return {time_of(header_s, topic, message), std::move(file),
          kNanosecond_s * static_cast<double>(message.received_ns), message.number};
}

void BagDrive::take_image(const BagTopic& topic, const BagMessage& message,
                          const std::string& prefix, std::vector<BagImage>& images) {
  const std::string name = prefix + numbered(message.number);
  if (topic.type == kRosImage.name) {
    const Stamped<RosImage> image = read_ros_image(message.bytes);
    fs::path file = files_.write(image.content, name);  // says first what is no image at all
    require_size(topic.name, image.content);
    images.push_back(image_of(image.time_s, std::move(file), topic, message));
  } else {
    const Stamped<RosCompressedImage> image = read_ros_compressed_image(message.bytes);
    fs::path file = files_.write(image.content, name);
    images.push_back(image_of(image.time_s, std::move(file), topic, message));
  }
}

void BagDrive::take_info(const BagTopic& topic, const BagMessage& message,
                         std::optional<BagCameraInfo>& info) const {
  const Stamped<RosCameraInfo> told = read_ros_camera_info(message.bytes);
  if (!info) {
    info = BagCameraInfo{told.content, where(topic, message)};
  } else if (!is_same_camera(info->info, told.content)) {
    throw BadMessage{"the calibration changes here"};
  }
}

void BagDrive::take_fix(const BagTopic& topic, const BagMessage& message) {
  auto stamped = read_ros_nav_sat_fix(message.bytes);
  if (!stamped.content) return;
  GpsRecord& fix = *stamped.content;
  if (!std::isfinite(fix.position.altitude_m)) fix.position.altitude_m = unknown_height();
  fix.time_s = time_of(stamped.time_s, topic, message);
  fix.label = label_of(topic.name);
  gps_.push_back(fix);
}

bool BagDrive::is_complete() const {
  return left_.size() > 1 && (info_ || !options_.calibration.empty());
}

/// Sorted by its time, such an image would be one of another place.
void BagDrive::leave_strays_out(const std::string& topic, std::vector<BagImage>& images,
                                ImportReport& report) {
  std::vector<MessageTime> times;
  times.reserve(images.size());
  for (const BagImage& image : images) times.push_back({image.time_s, image.received_s});
  const std::vector<StrayStamp> strays = stray_stamps(times);
  if (strays.empty()) return;
  const StrayStamp& first = strays.front();
  const bool one = strays.size() == 1;
  report.notes.push_back(
      std::to_string(strays.size()) + (one ? " image of " : " images of ") + topic +
      (one ? " is " : " are far off their neighbours' times, the first ") +
      fixed_text(std::abs(first.off_s), 0) + (first.off_s > 0.0 ? " s after" : " s before") +
      (one ? " its neighbours" : "") + " (message " + std::to_string(images[first.place].number) +
      "), and left out");
  for (auto stray = strays.rbegin(); stray != strays.rend(); ++stray) {
    images.erase(images.begin() + static_cast<std::ptrdiff_t>(stray->place));
  }
}

void BagDrive::put_images(ImageDrive& drive, ImportReport& report) {
  leave_strays_out(choice_.images, left_, report);
  leave_strays_out(choice_.right, right_, report);
  sort_by_time(left_);
  sort_by_time(right_);
  std::size_t doubled = 0;
  for (const BagImage& image : left_) {
    const bool again = !drive.times_s.empty() && !(image.time_s > drive.times_s.back());
    doubled += again ? 1U : 0U;
    if (again && !options_.fps) continue;
    drive.images.push_back(image.file);
    drive.times_s.push_back(image.time_s);
  }
  if (drive.images.size() < 2) {
    throw InputError(options_.source.string() + ": " + choice_.images,
                     std::to_string(left_.size()) + " images, but not two of different times",
                     "give the bag of a drive, or --fps");
  }
  if (doubled > 0 && !options_.fps) {
    report.notes.push_back(std::to_string(doubled) + " images of " + choice_.images +
                           " have the time of the one before and are left out");
  }
}

void BagDrive::put_camera(ImageDrive& drive, ImportReport& report) const {
  if (!options_.calibration.empty()) {
    drive.camera = calibration_for(options_.calibration, drive.images.front(), report);
    return;
  }
  if (!info_) {
    throw InputError(options_.source.string() + ": " + choice_.camera_info, "has no message",
                     "give the calibration with --calibration FILE[:SECTION]");
  }
  const bool rectified = is_rectified_topic(choice_.images);
  const CalibrationPlace place(info_->where, "CameraInfo");
  drive.camera = fitted_to(drive.images.front(), camera_of(info_->info, rectified, place),
                           info_->where, report);
  if (rectified) {
    report.notes.push_back("the name of " + choice_.images +
                           " says that its images are rectified: the calibration is P of " +
                           choice_.camera_info + "; give --calibration where they are not");
  }
}

void BagDrive::put_right(ImageDrive& drive, ImportReport& report) const {
  constexpr double kSameTime_s = 1e-3;  // a car at 20 m/s goes 2 cm in it
  if (choice_.right.empty() || !info_) return;
  const bool rectified =
      right_info_ && is_rectified_topic(choice_.images) == is_rectified_topic(choice_.right) &&
      (is_rectified_topic(choice_.images) ||
       (needs_no_rectifying(info_->info) && needs_no_rectifying(right_info_->info)));
  const std::string flag = "--right-topic " + choice_.right;
  if (!rectified) {
    throw InputError(flag, "the two cameras' images are not rectified as a pair",
                     "give the topics of image_rect, or leave it out");
  }
  RightImages right;
  right.baseline_m = place_in_pair(right_info_->info) - place_in_pair(info_->info);
  if (!is_same_projection(info_->info, right_info_->info)) {
    throw InputError(flag, "P of its CameraInfo has another f, cx or cy than that of the left one",
                     "correct P: of a rectified pair they are the same; or leave it out");
  }
  if (!is_baseline(right.baseline_m)) {
    throw InputError(flag, "is " + exact_text(right.baseline_m) + " m to the right of the left one",
                     "correct P of its CameraInfo, or leave it out");
  }
  std::size_t pairs = 0;
  for (const double time : drive.times_s) {
    const auto next =
        std::lower_bound(right_.begin(), right_.end(), time - kSameTime_s,
                         [](const BagImage& image, double t) { return image.time_s < t; });
    const bool there = next != right_.end() && next->time_s <= time + kSameTime_s;
    right.images.push_back(there ? next->file : fs::path());
    pairs += there ? 1U : 0U;
  }
  if (pairs == 0) {
    throw InputError(flag, "no image of it has the time of a left one", "leave it out");
  }
  report.notes.push_back(std::to_string(pairs) + " right images of " +
                         std::to_string(drive.images.size()) + ", " +
                         fixed_text(right.baseline_m, 3) + " m beside the left ones");
  drive.right = std::move(right);
}

void BagDrive::require_vehicles_imu() const {
  if (imu_.empty()) return;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const ImuRecord& sample : imu_) mean += sample.acceleration;
  mean /= static_cast<double>(imu_.size());
  constexpr double kGravity = 9.81, kTolerance = 1.0;  // [m/s²] a cheap unit's scale is 10 % off
  const std::string flag = "--imu-topic " + choice_.imu;
  if (std::abs(mean.norm() - kGravity) > kTolerance) {
    throw InputError(
        flag,
        "its mean acceleration is " + fixed_text(mean.norm(), 2) + " m/s^2, not that of gravity",
        "leave it out: it is in other units, or without gravity");
  }
  // The steepest road slopes 20 deg; another axis that points up is 90 deg off.
  const double off_deg = std::acos(std::clamp(mean.z() / mean.norm(), -1.0, 1.0)) * 180.0 / M_PI;
  constexpr double kMost_deg = 30.0;
  if (off_deg <= kMost_deg) return;
  throw InputError(flag,
                   "its Z axis is " + fixed_text(off_deg, 0) +
                       " deg off the vertical: its axes are not the vehicle's",
                   "leave it out");
}

void BagDrive::note_times(ImportReport& report) const {
  for (const auto& [topic, count] : without_time_) {
    report.notes.push_back(std::to_string(count) + " messages of " + topic +
                           " have no time: that of their recording is taken");
  }
}

ImageDrive BagDrive::drive(ImportReport& report) {
  ImageDrive drive;
  drive.label = label_of(choice_.images);
  drive.made = made_;
  put_images(drive, report);
  put_camera(drive, report);
  put_right(drive, report);
  require_vehicles_imu();
  if (options_.fps) {
    const double start_s = drive.times_s.front() - kImportEpoch_s;
    drive.times_s = stamps_of_fps(*options_.fps, drive.images.size());
    for (double& time : drive.times_s) time += start_s;
  }
  fill_heights(gps_);
  drive.gps = std::move(gps_);
  drive.imu = std::move(imu_);
  drive.wheels = std::move(wheels_);
  note_times(report);
  return drive;
}

}  // namespace oneac
