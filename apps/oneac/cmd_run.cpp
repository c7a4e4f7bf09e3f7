#include "commands.h"
#include "run/result_files.h"
#include "run/run_drive.h"
#include "run/run_georeference.h"
#include "run/run_gui.h"
#include "run/run_loops.h"
#include "run/run_options.h"
#include "run/run_outputs.h"
#include "run/run_report.h"
#include "run/run_summary.h"
#include "terminal/interrupt.h"
#include "terminal/key_flags.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/input_file.h"
#include "oneac/base/printable.h"
#include "oneac/comparison/plugin.h"

#include <CLI/CLI.hpp>

#include <chrono>
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
  std::vector<std::string> parameter_files;
  std::vector<std::string> settings;
  std::vector<std::string> plugins;
  bool print_params = false;
  bool no_progress = false;
  bool quiet = false;
  bool gui = false;
  bool loops = false;
};

bool learns_camera(const RunOptions& options) {
  return options.front_end.self_calibration.refine != "off";
}

void write_all(const DriveRecord& record, const std::optional<ClosedDrive>& closed,
               RunOptions& options, double wall_seconds) {
  const std::filesystem::path folder(options.output);
  write_drive(record, folder);
  if (closed) write_closed_drive(record, *closed, folder);
  const std::string camera =
      learns_camera(options) ? used_camera_ini(record, options.log) : std::string();
  if (!camera.empty()) write_file_atomically(folder / "camera.ini", camera);
  write_file_atomically(folder / "params.yaml", options.result_parameters());
  const ClosedDrive* loops = closed ? &*closed : nullptr;
  const RunEvaluation evaluation = evaluate_record(record, options, loops);
  const GeoreferenceResult& joined = evaluation.georeference;
  write_georeferenced(record, joined, options.run.georeference, folder);
  if (options.run.georeference && !joined.found && !options.run.quiet) {
    std::cerr << "oneac: the drive is not joined to the GPS: " << printable(joined.reason) << '\n';
  }
  const std::string summary = summary_json(record, evaluation, options, wall_seconds, loops);
  write_file_atomically(folder / "summary.json", summary);
  write_file_atomically(folder / "report.html",
                        report_html(record, evaluation, options, summary, loops));
  write_file_atomically(folder / "files.json", manifest_json(folder, record.has_scale()));
  std::cout << summary_text(record, evaluation)
            << (closed ? text_about(*closed, evaluation.closed_against_poses) : std::string())
            << "written to " << options.output << ": " << names_of_results(folder) << '\n';
}

/// Before the results of an earlier run are taken away: a mistyped name costs nobody a drive.
void require_log(const std::string& log) {
  const std::string fault = fault_of_file(log);
  if (!fault.empty()) throw InputError(log, fault, "check the name of the log");
}

void run(RunFlags& flags) {
  RunOptions& options = flags.options;
  for (const std::string& plugin : flags.plugins) load_plugin(plugin);
  apply_settings(flags.parameter_files, flags.settings, options);
  if (flags.print_params) {
    std::cout << options.table().to_yaml(true);
    return;
  }
  if (flags.no_progress) options.run.progress = false;
  if (flags.quiet) options.run.quiet = true;
  if (flags.loops) options.run.loops = true;
  options.validate();
  if (options.log.empty()) throw InputError("run", "no rawlog given", "oneac run LOG -o DIR");
  if (options.output.empty()) throw InputError("run", "no output folder given", "add -o DIR");
  require_writable_folder(options.output);
  require_log(options.log);
  if (learns_camera(options)) require_no_other_camera(options.output);
  require_no_other_results(options.output);
  clear_of_earlier_run(options.output);
  catch_interrupts();
  const auto gui = flags.gui ? std::make_unique<RunGui>() : nullptr;
  const auto start = std::chrono::steady_clock::now();
  RunObserver observer;
  if (gui) observer = [&](const RunMoment& moment) { gui->show(moment); };
  DriveRecord record = run_drive(options, observer);
  std::optional<ClosedDrive> closed;
  if (options.run.loops && !record.frames.empty()) closed = close_loops(record, options);
  record.interrupted = record.interrupted || (closed && interrupted());
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  if (!options.run.quiet) {
    for (const std::string& note : notes_about(record))
      std::cerr << "oneac: " << printable(note) << '\n';
    if (closed && !closed->note.empty()) std::cerr << "oneac: " << printable(closed->note) << '\n';
  }
  fail_if_empty(record, options.log);
  write_all(record, closed, options, wall.count());
  if (gui && !record.interrupted) gui->wait(record);
  fail_if_incomplete(record);
}

}  // namespace

void add_run(CLI::App& program) {
  auto* verb = program.add_subcommand("run", "Computes the trajectory of a camera from a rawlog");
  auto flags = std::make_shared<RunFlags>();
  verb->add_option("LOG", flags->options.log, "rawlog: plain, .gz or zstd");
  verb->add_option("-o,--output", flags->options.output, "folder for the results, made if missing");
  verb->add_option("--params", flags->parameter_files, "YAML with parameters; may be repeated")
      ->allow_extra_args(false);
  verb->add_option("--set", flags->settings, "section.key=value, any key of params/default.yaml")
      ->allow_extra_args(false);
  add_key(*verb, "--initialiser", "front_end.initialiser", flags->settings,
          "method of the relative pose");
  verb->add_option("--plugin", flags->plugins, "library with initialisers; may be repeated")
      ->allow_extra_args(false);
  add_selection(*verb, flags->settings);
  add_key(*verb, "--camera-height", "front_end.camera_height", flags->settings,
          "metres of the lens above the road; without it the log's, if it tells one");
  add_key(*verb, "--reference", "run.reference", flags->settings, "true poses, KITTI or TUM");
  add_key(*verb, "--seed", "run.seed", flags->settings, "seed of methods that draw random numbers");
  add_key(*verb, "--threads", "run.threads", flags->settings, "images prepared at once");
  verb->add_flag_callback(
      "--georeference", [flags] { flags->settings.emplace_back("run.georeference=true"); },
      "write trajectory_enu.tum as well: the vehicle's way in the frame of the log's GPS");
  verb->add_flag("--loops", flags->loops,
                 "find places seen again, measure them in metres, close the drive by them");
  verb->add_flag("--gui", flags->gui, "show the drive in a window while it is computed");
  verb->add_flag("--no-progress", flags->no_progress, "no progress bar");
  verb->add_flag("--quiet", flags->quiet, "no progress bar, notes or warnings");
  verb->add_flag("--print-params", flags->print_params, "print all parameters as YAML and stop");
  verb->callback([flags] { run(*flags); });
}

}  // namespace oneac::app
