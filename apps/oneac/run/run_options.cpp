#include "run_options.h"

#include "oneac/base/error.h"
#include "oneac/base/finite_number.h"
#include "oneac/initialisers/yaml_parameters.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace oneac::app {

// Found by ParameterTable through the namespace of its argument.
template <class Visitor>
void describe(Visitor&& visit, SourceParameters& o) {
  visit("camera", o.camera, "name", "left, right or a sensor label; empty: the only one");
  visit("images_dir", o.images_dir, "path", "external images; empty: searched beside the log");
  visit("mask_dir", o.mask_dir, "path",
        "a mask per image, called as it is: dark where it is not used; empty: none");
  visit("calibration", o.calibration, "path", "FILE[:SECTION] that replaces the log's");
  visit("undistorted_fov_deg", o.undistorted_fov_deg, "deg",
        "across undistorted images; 0: chosen to keep the road");
  visit("mount_convention", o.mount_convention, "name", "auto, optical or x_forward sensor poses");
  visit("mount_roll_deg", o.mount_roll_deg, "deg",
        "camera's roll, to the right: 180 upside down, 90 portrait");
  visit("mount_pitch_deg", o.mount_pitch_deg, "deg", "its axis above the horizon");
  visit("mount_yaw_deg", o.mount_yaw_deg, "deg",
        "to the left: 180 rear; all three empty: as the log says");
  visit("first", o.first, "index", "first image to use");
  visit("count", o.count, "count", "images to use at most; 0: all");
  visit("every", o.every, "count", "use every K-th image");
}

template <class Visitor>
void describe_results(Visitor&& visit, RunParameters& o) {
  visit("reference", o.reference, "path", "true poses; empty: beside the log, else its GPS");
  visit("seed", o.seed, "-", "of methods that draw random numbers");
  visit("georeference", o.georeference, "bool",
        "write trajectory_enu.tum, in the frame of the GPS");
}

template <class Visitor>
void describe(Visitor&& visit, RunParameters& o) {
  describe_results(visit, o);
  visit("loops", o.loops, "bool", "close loops, and write what comes of it beside the rest");
  visit("global_ba", o.global_ba, "bool",
        "with loops: adjust keyframes and patches of the closed drive together");
  visit("threads", o.threads, "count", "threads that share a drive; changes no result");
  visit("progress", o.progress, "bool", "progress bar on a terminal");
  visit("quiet", o.quiet, "bool", "no notes and warnings");
}

namespace {

/// Zero for an angle that is not given.
double angle_of(const char* key, const std::string& text) {
  if (text.empty()) return 0.0;
  if (const auto angle = finite_number(text)) return *angle;
  throw std::invalid_argument(std::string(key) + " = '" + text + "', must be a number of degrees");
}

/// "window.fixed = 9, …" as whoever typed it calls it: front_end.window.fixed, or a flag.
[[noreturn]] void fail_by_bound(const std::string& fault, const ParameterTable& table,
                                const std::vector<Setting>& settings) {
  constexpr std::string_view kIs = " = ";
  const auto end = std::min(fault.find(' '), fault.size());
  const std::string key = table.full_key(fault.substr(0, end));
  const auto typed = std::find_if(settings.rbegin(), settings.rend(),
                                  [&](const Setting& setting) { return setting.key == key; });
  const bool by_flag = typed != settings.rend() && typed->typed.rfind("--set", 0) != 0;
  if (by_flag && fault.compare(end, kIs.size(), kIs) == 0) {
    throw InputError(typed->typed + " " + typed->value, fault.substr(end + kIs.size()),
                     "correct the flag");
  }
  throw InputError("parameters", key + fault.substr(end), "correct it in --params or --set");
}

/// RunParameters without what cannot change a result.
struct ResultParameters {
  RunParameters& run;
};
template <class Visitor>
void describe(Visitor&& visit, ResultParameters& o) {
  describe_results(visit, o.run);
  if (o.run.loops) visit("loops", o.run.loops, "bool", "loops were looked for");
  if (o.run.global_ba) visit("global_ba", o.run.global_ba, "bool", "and the whole adjusted");
}

}  // namespace

std::optional<MountAngles> SourceParameters::mount() const {
  if (mount_roll_deg.empty() && mount_pitch_deg.empty() && mount_yaw_deg.empty()) {
    return std::nullopt;
  }
  const MountAngles mount{angle_of("mount_roll_deg", mount_roll_deg),
                          angle_of("mount_pitch_deg", mount_pitch_deg),
                          angle_of("mount_yaw_deg", mount_yaw_deg)};
  mount.validate();
  return mount;
}

SourceOptions SourceParameters::for_log(const std::string& log) const {
  SourceOptions options;
  options.log = log;
  options.images_dir = images_dir;
  options.mask_dir = mask_dir;
  options.camera = camera;
  options.calibration = calibration;
  options.undistorted_fov_deg = undistorted_fov_deg;
  options.mount_convention = mount_convention;
  options.mount = mount();
  options.first = first;
  options.count = count;
  options.every = every;
  return options;
}

ParameterTable RunOptions::table() {
  ParameterTable table;
  table.add("source", source);
  table.add("front_end", front_end);
  table.add("loops", loops);
  table.add("global_ba", global_ba);
  table.add("run", run);
  return table;
}

std::string RunOptions::result_parameters() {
  ResultParameters results{run};
  ParameterTable table;
  table.add("source", source);
  table.add("front_end", front_end);
  if (run.loops) table.add("loops", loops);
  if (run.global_ba) table.add("global_ba", global_ba);
  table.add("run", results);
  return table.to_yaml(true);
}

void RunOptions::validate() {
  try {
    source.for_log(log).validate();
    table().check_bounds();
    front_end.validate();
    loops.validate();
    global_ba.validate();
    if (run.threads < 1) {
      throw std::invalid_argument("run.threads = " + std::to_string(run.threads) +
                                  ", must be at least 1");
    }
  } catch (const std::invalid_argument& error) {
    fail_by_bound(error.what(), table(), settings);
  }
  if (run.global_ba && !run.loops) {
    throw InputError("--global-ba", "adjusts a drive that loops have closed", "add --loops");
  }
}

std::vector<std::string> inputs_of(const RunOptions& options) {
  const std::string& calibration = options.source.calibration;
  return {options.log, options.run.reference, calibration,
          calibration.substr(0, calibration.rfind(':')),  // FILE:SECTION
          options.front_end.features.mask.image};
}

void apply_settings(const std::vector<std::string>& files, const std::vector<Setting>& settings,
                    RunOptions& options) {
  options.settings = settings;
  ParameterTable table = options.table();
  for (const std::string& file : files) apply_yaml_file(file, table);
  for (const Setting& setting : settings) {
    try {
      table.set(setting.key, setting.value);
    } catch (const std::invalid_argument& error) {
      throw InputError(setting.typed, error.what(), "see params/default.yaml for all keys");
    }
  }
}

}  // namespace oneac::app
