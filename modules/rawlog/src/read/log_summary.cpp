#include "oneac/rawlog/log_summary.h"

#include "images/external_images.h"
#include "read/camera_selection.h"
#include "read/log_reader.h"
#include "read/reference_collector.h"

#include "oneac/base/median.h"
#include "oneac/mrpt_compat/observations.h"
#include "oneac/rawlog/calibration.h"

#include <mrpt/obs/CObservationComment.h>

#include <algorithm>
#include <map>
#include <utility>

namespace oneac {
namespace {

// Observations per interval whose duration is measured: GPS receivers deliver in bursts.
constexpr std::size_t kRateLag = 10;

using Times = std::vector<double>;

std::optional<double> rate_of(Times times) {
  if (times.size() < 2) return std::nullopt;
  std::sort(times.begin(), times.end());
  const std::size_t lag = std::min(kRateLag, times.size() - 1);
  Times spans;
  for (std::size_t i = lag; i < times.size(); ++i) spans.push_back(times[i] - times[i - lag]);
  const double span = upper_median(std::move(spans));
  if (span <= 0.0) return std::nullopt;
  return static_cast<double>(lag) / span;
}

/// Everything that grows during the pass.
class Summariser {
 public:
  explicit Summariser(const SummaryOptions& options)
      : options_(options), images_(options.log, options.images_dir) {}

  void add(const RawlogRecord& record);
  [[nodiscard]] LogSummary finish(const LogReader& reader);

 private:
  struct Sensor {
    std::size_t count = 0;
    Times times;
  };

  void add_view(const LogView& view, std::size_t record);
  void describe(CameraSummary& camera, const CameraView& view, std::size_t record) const;
  void add_sensors(LogSummary& summary) const;
  void add_reference(LogSummary& summary) const;

  SummaryOptions options_;
  ExternalImages images_;
  std::map<std::pair<std::string, std::string>, Sensor> sensors_;
  std::map<std::string, CameraSummary> cameras_;
  ReferenceCollector collector_;
};

void Summariser::add(const RawlogRecord& record) {
  const auto& observation = *record.observation;
  auto& sensor = sensors_[{observation.sensorLabel, compat::class_name(observation)}];
  ++sensor.count;
  // A comment is stamped when somebody writes it, not during the drive.
  const bool stamped = observation.timestamp != INVALID_TIMESTAMP &&
                       dynamic_cast<const mrpt::obs::CObservationComment*>(&observation) == nullptr;
  if (stamped) {
    sensor.times.push_back(compat::unix_seconds(observation.timestamp));
  }
  for (const auto& view : log_views(record)) add_view(view, record.number);
  collector_.add(observation);
}

void Summariser::add_view(const LogView& view, std::size_t record) {
  auto& camera = cameras_[view.name()];
  if (camera.images++ == 0) describe(camera, view, record);
  if (is_present(view, images_)) ++camera.present;
}

void Summariser::describe(CameraSummary& camera, const CameraView& view, std::size_t record) const {
  camera.name = view.name();
  camera.mount = mount_from_sensor_pose(view.T_vehicle_sensor, options_.mount_convention);
  try {
    camera.calibration = options_.calibration.empty()
                             ? to_pinhole(*view.calibration, "record " + std::to_string(record))
                             : load_calibration(options_.calibration, view.side_name());
  } catch (const InputError& error) {
    if (!options_.calibration.empty()) throw;
    camera.calibration_fault = error.what();
  }
  const bool rectified = camera.calibration && !camera.calibration->is_distorted();
  camera.mount.T_vehicle_cam = camera.mount.T_vehicle_cam * view.offset_in_pair(rectified);
}

void Summariser::add_sensors(LogSummary& summary) const {
  for (const auto& [key, sensor] : sensors_) {
    SensorSummary line{key.first, key.second, sensor.count, rate_of(sensor.times), {}, {}};
    summary.observations += sensor.count;
    if (key.second == "CObservationGPS") summary.gps_observations += sensor.count;
    if (key.second == "CObservationIMU") summary.imu_observations += sensor.count;
    if (key.second == "CObservationOdometry") summary.wheel_observations += sensor.count;
    if (!sensor.times.empty()) {
      const auto ends = std::minmax_element(sensor.times.begin(), sensor.times.end());
      line.first_s = *ends.first;
      line.last_s = *ends.second;
      summary.first_s = std::min(summary.first_s.value_or(*ends.first), *ends.first);
      summary.last_s = std::max(summary.last_s.value_or(*ends.second), *ends.second);
    }
    summary.sensors.push_back(std::move(line));
  }
}

void Summariser::add_reference(LogSummary& summary) const {
  for (const auto& fix : collector_.build().gps) {
    summary.gps_epochs_with_position += fix.position_enu ? 1 : 0;
    summary.gps_epochs_with_speed += fix.speed ? 1 : 0;
  }
}

LogSummary Summariser::finish(const LogReader& reader) {
  LogSummary summary;
  summary.log = options_.log;
  summary.format = reader.format();
  summary.compression = reader.compression();
  summary.damage = reader.damage();
  summary.calibration_overridden = !options_.calibration.empty();
  summary.searched_folders = images_.searched();
  for (const auto& folder : images_.used()) summary.image_folders.push_back(folder.string());
  for (auto& [name, camera] : cameras_) summary.cameras.push_back(std::move(camera));
  add_sensors(summary);
  add_reference(summary);
  return summary;
}

}  // namespace

LogSummary summarise_log(const SummaryOptions& options) {
  LogReader reader(options.log);
  Summariser summariser(options);
  while (const auto record = reader.next()) summariser.add(*record);
  return summariser.finish(reader);
}

}  // namespace oneac
