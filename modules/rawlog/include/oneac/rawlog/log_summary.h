#pragma once

#include "oneac/base/error.h"
#include "oneac/geometry/camera.h"
#include "oneac/observations/sensor_mount.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// What to look at; the fields mean the same as in SourceOptions.
struct SummaryOptions {
  std::filesystem::path log;
  std::filesystem::path images_dir;
  std::string calibration;
  std::string mount_convention = "auto";
};

/// The observations of one class under one sensor label.
struct SensorSummary {
  std::string label;
  std::string class_name;
  std::size_t count = 0;
  std::optional<double> rate_hz;  ///< median over ten observations each; empty without a time span
  std::optional<double> first_s;  ///< Unix time [s] of the first observation that has one
  std::optional<double> last_s;   ///< Unix time [s]
};

/// One camera: the only one of an image sensor, or one half of a stereo sensor.
struct CameraSummary {
  std::string name;                          ///< selects it: "LABEL", "LABEL/left", "LABEL/right"
  std::size_t images = 0;                    ///< in the log
  std::size_t present = 0;                   ///< of them, stored in the log or found as a file
  std::optional<PinholeCamera> calibration;  ///< empty: see calibration_fault
  std::string calibration_fault;
  SensorMount mount;
};

/// What a rawlog holds, from one pass over it.
struct LogSummary {
  std::filesystem::path log;
  std::string format;       ///< "observations", "action/sensory-frame pairs", "mixed"
  std::string compression;  ///< "plain", "gzip", "zstd"
  std::size_t observations = 0;
  std::optional<double> first_s;           ///< earliest time stamp, Unix [s]
  std::optional<double> last_s;            ///< latest
  std::vector<SensorSummary> sensors;      ///< by label and class
  std::vector<CameraSummary> cameras;      ///< by name
  std::vector<std::string> image_folders;  ///< in which external images were found
  std::string searched_folders;            ///< in which they were looked for
  bool calibration_overridden = false;
  std::size_t gps_observations = 0;
  std::size_t gps_epochs_with_position = 0;  ///< of the receiver with the most epochs
  std::size_t gps_epochs_with_speed = 0;
  std::size_t imu_observations = 0;
  std::size_t wheel_observations = 0;  ///< CObservationOdometry
  std::optional<InputError> damage;  ///< where and how the log ends badly; all above is before that
};

/// Reads through the log once. Memory: 8 bytes per observation for the rates, and the GPS and IMU.
/// @throws InputError when the log, the images dir or the calibration cannot be used at all
[[nodiscard]] LogSummary summarise_log(const SummaryOptions& options);

/// The same for people, many lines, damage not included.
[[nodiscard]] std::string to_text(const LogSummary& summary);

}  // namespace oneac
