#pragma once

#include "terminal/setting.h"

#include "oneac/base/parameter_table.h"
#include "oneac/frontend/front_end_options.h"
#include "oneac/loops/global_adjustment.h"
#include "oneac/loops/loop_options.h"
#include "oneac/rawlog/rawlog_source.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace oneac::app {

/// Which images: SourceOptions in the types of a parameter file.
struct SourceParameters {
  std::string camera;
  std::string images_dir;
  std::string mask_dir;
  std::string calibration;
  double undistorted_fov_deg = 0.0;
  std::string mount_convention = "auto";
  std::string mount_roll_deg, mount_pitch_deg, mount_yaw_deg;  ///< numbers, or empty
  std::size_t first = 0;
  std::size_t count = 0;
  std::size_t every = 1;

  /// @throws std::invalid_argument naming a key whose text is no angle, or out of bounds
  [[nodiscard]] SourceOptions for_log(const std::string& log) const;
  /// The orientation of the camera, where one of its angles is given: the others are zero then.
  /// @throws std::invalid_argument as for_log()
  [[nodiscard]] std::optional<MountAngles> mount() const;
};

/// How to run. None of threads, progress, quiet changes a result.
struct RunParameters {
  std::string reference;  ///< true poses; "" looks beside the log, then takes the log's GPS
  int seed = 0;           ///< for methods that draw random numbers; the one-AC consensus does not
  bool georeference = false;  ///< the way in the frame of the GPS, too
  bool loops = false;         ///< look for places seen again and close the drive by them
  bool global_ba = false;     ///< then adjust keyframes and patches of the closed drive together
  int threads = 2;            ///< that share a drive
  bool progress = true;
  bool quiet = false;
};

/// Everything `oneac run` can be told, from defaults, --params, --set and flags, in this order.
struct RunOptions {
  std::string log;
  std::string output;
  SourceParameters source;
  FrontEndOptions front_end;
  LoopOptions loops;
  GlobalOptions global_ba;
  RunParameters run;
  std::vector<Setting> settings;              ///< what was applied last, for messages
  std::optional<PinholeCamera> camera_model;  ///< instead of source.calibration; no parameter

  /// All keys; borrows this object.
  [[nodiscard]] ParameterTable table();
  /// The effective parameters that results depend on, as YAML.
  [[nodiscard]] std::string result_parameters();
  /// @throws InputError naming key, value and bound
  void validate();
};

/// Files that a run with these options reads; some names may be empty.
[[nodiscard]] std::vector<std::string> inputs_of(const RunOptions& options);

/// Applies parameter files, then settings. @throws InputError naming the file or flag
void apply_settings(const std::vector<std::string>& files, const std::vector<Setting>& settings,
                    RunOptions& options);

}  // namespace oneac::app
