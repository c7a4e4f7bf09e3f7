#include "calibrate/calibration_outputs.h"
#include "commands.h"
#include "run/run_outputs.h"
#include "terminal/interrupt.h"
#include "terminal/key_flags.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/input_file.h"
#include "oneac/base/printable.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

namespace oneac::app {
namespace {

/// The page of a run has the same name, and its results belong together.
void require_no_run(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (!std::filesystem::exists(folder / "summary.json", ignored)) return;
  throw InputError(folder.string(), "it holds the results of a run, whose report.html would go",
                   "name a file in another folder with -o");
}

/// camera.ini's neighbour with the height, camera_height.yaml.
std::filesystem::path height_file(const std::filesystem::path& file) {
  return file.parent_path() / (file.stem().string() + "_height.yaml");
}

/// One that no calibration has made is nobody's to overwrite.
void require_own(const std::filesystem::path& file) {
  if (const std::string fault = fault_of_place(file); !fault.empty()) {
    throw InputError(file.string(), fault + ", where a file is to be written",
                     "give another name with -o");
  }
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored) || is_made_by_calibrate(file)) return;
  throw InputError(file.string(), "it exists, and oneac calibrate has not made it",
                   "move it away, or give another name with -o");
}

/// Writes the height, or takes that of an earlier drive away. @return ", its name", or ""
std::string write_height(const Calibration& calibration, const std::string& log,
                         const std::filesystem::path& file) {
  const std::string yaml = height_yaml(calibration, log);
  std::error_code ignored;
  if (yaml.empty()) {
    std::filesystem::remove(file, ignored);
    return "";
  }
  write_file_atomically(file, yaml);
  return ", " + file.string() + " (for --params)";
}

struct CalibrateFlags {
  CalibrateOptions options;
  std::vector<std::string> parameter_files;
  std::vector<Setting> settings;
  bool no_progress = false;
};

void require_not_the_log(const std::filesystem::path& file, const std::string& log) {
  if (!is_same_file(file, log)) return;
  throw InputError(file.string(), "is the log, which the calibration would replace",
                   "give -o a name such as camera.ini");
}

void run(CalibrateFlags& flags) {
  CalibrateOptions& options = flags.options;
  apply_settings(flags.parameter_files, flags.settings, options.run);
  if (flags.no_progress) options.run.run.progress = false;
  options.validate();
  const std::filesystem::path file(options.output);
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  require_not_the_log(file, options.run.log);
  require_writable_folder(folder.string());
  require_no_run(folder);
  for (const std::filesystem::path& own : {file, height_file(file), folder / "report.html"}) {
    require_own(own);
  }
  catch_interrupts();
  const Calibration calibration = calibrate_camera(options);
  fail_if_empty(calibration.drive, options.run.log);
  write_file_atomically(file, camera_ini(calibration, options.run.log));
  write_file_atomically(folder / "report.html", calibration_html(calibration, options.run.log));
  const std::string height = write_height(calibration, options.run.log, height_file(file));
  std::cout << calibration_summary(calibration) << "written: " << printable(file.string()) << height
            << ", " << printable((folder / "report.html").string()) << '\n';
  fail_if_incomplete(calibration.drive);
}

}  // namespace

void add_calibrate(CLI::App& program) {
  auto* verb = program.add_subcommand(
      "calibrate",
      "Focal length, principal point, distortion and height of a camera out of a drive");
  auto flags = std::make_shared<CalibrateFlags>();
  verb->add_option("LOG", flags->options.run.log, "rawlog: plain, .gz or zstd");
  verb->add_option("-o,--output", flags->options.output,
                   "file to write, for --calibration; report.html comes beside it, and where the "
                   "log tells metres NAME_height.yaml, the camera's height for --params");
  verb->add_option("--fov-deg", flags->options.fov_deg,
                   "guess of the horizontal field of view, instead of the log's calibration; "
                   "60 where there is neither");
  verb->add_flag("--fisheye", flags->options.fisheye,
                 "begin with a fisheye (Kannala-Brandt) of this field of view; 120 without one");
  verb->add_option("--passes", flags->options.passes, "over the drive, at most")
      ->capture_default_str();
  add_parameters(*verb, flags->parameter_files, flags->settings);
  add_selection(*verb, flags->settings);
  add_key(*verb, "--threads", "run.threads", flags->settings, "threads that share a drive");
  verb->add_flag("--no-progress", flags->no_progress, "no progress bar");
  verb->callback([flags] { run(*flags); });
}

}  // namespace oneac::app
