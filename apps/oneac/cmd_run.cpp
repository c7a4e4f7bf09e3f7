#include "commands.h"
#include "run/result_files.h"
#include "run/run_drive.h"
#include "run/run_gui.h"
#include "run/run_logs.h"
#include "run/run_loops.h"
#include "run/run_options.h"
#include "run/run_outputs.h"
#include "run/run_results.h"
#include "terminal/interrupt.h"
#include "terminal/key_flags.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/input_file.h"
#include "oneac/base/printable.h"
#include "oneac/comparison/plugin.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/rawlog/calibration.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>

namespace oneac::app {
namespace {

/// What the flags say; they override parameter files, which were applied before.
struct RunFlags {
  RunOptions options;
  std::vector<std::string> logs;
  std::vector<std::string> parameter_files;
  std::vector<Setting> settings;
  std::vector<std::string> plugins;
  bool print_params = false;
  bool no_progress = false;
  bool quiet = false;
  bool gui = false;
  bool loops = false;
  bool global_ba = false;
};

/// Before the results of an earlier run are taken away: a mistyped name costs nobody a drive.
void require_log(const std::string& log) {
  const std::string fault = fault_of_file(log);
  if (!fault.empty()) throw InputError(log, fault, "check the name of the log");
}

/// The same of what is read beside the log.
void require_inputs(const RunOptions& options, std::size_t logs) {
  const std::string& reference = options.run.reference;
  if (!reference.empty() && logs == 1) static_cast<void>(read_trajectory(reference));
  const SourceParameters& source = options.source;
  if (!source.calibration.empty()) {
    static_cast<void>(load_calibration(source.calibration, source.camera));
  }
}

/// What the flags ask for, in one place.
void settle(RunFlags& flags) {
  RunOptions& options = flags.options;
  if (flags.no_progress) options.run.progress = false;
  if (flags.quiet) options.run.quiet = true;
  if (flags.loops) options.run.loops = true;
  if (flags.global_ba) options.run.global_ba = true;
  options.validate();
  if (flags.logs.empty()) throw InputError("run", "no rawlog given", "oneac run LOG -o DIR");
  if (options.output.empty()) throw InputError("run", "no output folder given", "add -o DIR");
  require_writable_folder(options.output);
  for (const std::string& log : flags.logs) require_log(log);
  require_inputs(options, flags.logs.size());
}

void run_one(RunFlags& flags) {
  RunOptions& options = flags.options;
  options.log = flags.logs.front();
  require_own_results({options.output, learns_camera(options), inputs_of(options)});
  clear_of_earlier_run(options.output);
  catch_interrupts();
  const auto gui = flags.gui ? std::make_unique<RunGui>() : nullptr;
  const auto start = std::chrono::steady_clock::now();
  RunObserver observer;
  if (gui) observer = [&](const RunMoment& moment) { gui->show(moment); };
  DriveRecord record = run_drive(options, observer);
  ClosedDrives closed;
  const bool close = options.run.loops && !record.frames.empty();
  if (close) closed = close_loops({{&record, &options}});
  record.interrupted = record.interrupted || (close && interrupted());
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  const ClosedDrive* drive = close ? &closed.drives.front() : nullptr;
  tell_notes(record, drive, options);
  fail_if_empty(record, options.log);
  write_results(record, drive, options, wall.count());
  if (gui && !record.interrupted) gui->wait(record);
  fail_if_incomplete(record);
}

void run(RunFlags& flags) {
  for (const std::string& plugin : flags.plugins) load_plugin(plugin);
  apply_settings(flags.parameter_files, flags.settings, flags.options);
  if (flags.print_params) {
    std::cout << flags.options.table().to_yaml(true);
    return;
  }
  settle(flags);
  if (flags.logs.size() == 1) return run_one(flags);
  if (flags.gui) throw InputError("--gui", "shows one drive", "run the logs one by one with it");
  run_logs(flags.logs, flags.options);
}

}  // namespace

void add_run(CLI::App& program) {
  auto* verb = program.add_subcommand("run", "Computes the trajectory of a camera from a rawlog");
  auto flags = std::make_shared<RunFlags>();
  verb->add_option("LOG", flags->logs,
                   "rawlog: plain, .gz or zstd; several are joined where they overlap (--loops)");
  verb->add_option("-o,--output", flags->options.output, "folder for the results, made if missing");
  add_parameters(*verb, flags->parameter_files, flags->settings);
  add_key(*verb, "--initialiser", "front_end.initialiser", flags->settings,
          "method of the relative pose");
  verb->add_option("--plugin", flags->plugins, "library with initialisers; may be repeated")
      ->allow_extra_args(false);
  add_selection(*verb, flags->settings);
  add_key(*verb, "--camera-height", "front_end.camera_height", flags->settings,
          "metres of the lens above the road; without it the log's, if it tells one");
  add_key(*verb, "--reference", "run.reference", flags->settings, "true poses, KITTI or TUM");
  add_key(*verb, "--seed", "run.seed", flags->settings, "seed of methods that draw random numbers");
  add_key(*verb, "--threads", "run.threads", flags->settings, "threads that share a drive");
  verb->add_flag_callback(
      "--georeference",
      [flags] {
        flags->settings.push_back({"--georeference", "run.georeference", "true"});
      },
      "write trajectory_enu.tum as well: the vehicle's way in the frame of the log's GPS");
  verb->add_flag("--loops", flags->loops,
                 "find places seen again, measure them in metres, close the drive by them; join "
                 "several logs, whose results go to DIR/1, DIR/2, ...");
  verb->add_flag("--global-ba", flags->global_ba,
                 "with --loops: then adjust all keyframes and what they saw together");
  verb->add_flag("--gui", flags->gui, "show the drive in a window while it is computed");
  verb->add_flag("--no-progress", flags->no_progress, "no progress bar");
  verb->add_flag("--quiet", flags->quiet, "no progress bar, notes or warnings");
  verb->add_flag("--print-params", flags->print_params, "print all parameters as YAML and stop");
  verb->callback([flags] { run(*flags); });
}

}  // namespace oneac::app
