#pragma once

#include "images/log_image.h"
#include "read/action_odometry.h"

#include "oneac/base/error.h"

#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cstddef>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace oneac {

/// One observation and the number of the top-level record (from 0) that it came in.
struct RawlogRecord {
  std::size_t number = 0;
  mrpt::obs::CObservation::Ptr observation;
  /// Of the whole top-level record; the observation's CImages are external ones whose file is a
  /// number in here.
  std::shared_ptr<const LogImages> images;
};

/// Streams the observations of a rawlog in log order: out of plain observations and out of sensory
/// frames alike, and the odometry of actions as that of an odometer. Holds one record at a time.
///
/// After damage it ends; what came before it has been delivered.
class LogReader {
 public:
  /// @throws InputError when there is no such file, or it does not begin with a readable record
  explicit LogReader(std::filesystem::path log);
  ~LogReader();

  /// The next observation; nothing at the end of what can be read.
  [[nodiscard]] std::optional<RawlogRecord> next();
  /// Set once the log ended badly: file, record, fault, cure.
  [[nodiscard]] const std::optional<InputError>& damage() const { return damage_; }
  [[nodiscard]] const std::string& compression() const;
  /// "observations", "action/sensory-frame pairs" or "mixed", as far as read.
  [[nodiscard]] std::string format() const;
  [[nodiscard]] double progress() const;

 private:
  struct Archive;
  bool read_record();
  void take(const std::shared_ptr<mrpt::serialization::CSerializable>& object);
  void take_actions(mrpt::obs::CActionCollection& actions,
                    const std::shared_ptr<const LogImages>& images);
  void take_frame(const mrpt::obs::CSensoryFrame& frame,
                  const std::shared_ptr<const LogImages>& images);
  void set_damage(const std::string& said);

  std::filesystem::path log_;
  std::unique_ptr<Archive> archive_;
  std::deque<RawlogRecord> ready_;
  ActionOdometry odometry_;
  mrpt::obs::CObservationOdometry::Ptr without_time_;  ///< gets that of the frame that follows
  std::size_t records_ = 0;
  bool has_pairs_ = false;
  bool has_observations_ = false;
  std::optional<InputError> damage_;
};

}  // namespace oneac
