#include "run_logs.h"

#include "result_files.h"
#include "run_drive.h"
#include "run_logs_report.h"
#include "run_loops.h"
#include "run_outputs.h"
#include "run_results.h"
#include "terminal/interrupt.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/input_file.h"
#include "oneac/base/printable.h"
#include "oneac/rawlog/rawlog_source.h"

#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <optional>
#include <system_error>
#include <utility>

namespace oneac::app {
namespace {

namespace fs = std::filesystem;

// [-] of the focal length: a third of a pixel at the border of a usual image, what correspondences
// are good to.
constexpr double kSameCamera = 1e-3;

void require_logs_that_can_be_joined(const std::vector<std::string>& logs,
                                     const RunOptions& options) {
  if (!options.run.loops) {
    throw InputError("run", std::to_string(logs.size()) + " logs are given, and loops join them",
                     "add --loops, or run the logs one by one");
  }
  if (!options.run.reference.empty()) {
    throw InputError("--reference", "belongs to one log, and several are given",
                     "lay the poses beside each log as <log>_poses.txt");
  }
  for (std::size_t i = 1; i < logs.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      // The loops of a drive with itself would all be right, and all be its own.
      if (is_same_file(logs[k], logs[i])) {
        throw InputError(logs[i], "is given twice", "name each log once");
      }
    }
  }
}

/// Of the log's first image; nothing where there is none, which the run says better.
std::optional<PinholeCamera> camera_of(const RunOptions& options) {
  SourceOptions source = options.source.for_log(options.log);
  source.camera_model = options.camera_model;
  RawlogSource log(source);
  const auto ticket = log.next();
  if (!ticket) return std::nullopt;
  return log.load(*ticket).camera;
}

bool is_same(const PinholeCamera& a, const PinholeCamera& b) {
  const double most = kSameCamera * a.focal_px();
  return a.width == b.width && a.height == b.height && std::abs(a.fx - b.fx) < most &&
         std::abs(a.fy - b.fy) < most && std::abs(a.cx - b.cx) < most &&
         std::abs(a.cy - b.cy) < most;
}

/// Before hours of driving: images of two cameras are not compared.
void require_one_camera(const std::vector<RunOptions>& logs) {
  std::optional<PinholeCamera> first;
  for (const RunOptions& log : logs) {
    const auto camera = camera_of(log);
    if (camera && first && !is_same(*first, *camera)) {
      throw InputError(log.log, "its camera is another than that of " + logs.front().log,
                       "run it alone");
    }
    if (!first) first = camera;
  }
}

/// The options of each log, with a folder of its own.
std::vector<RunOptions> options_of_logs(const std::vector<std::string>& logs,
                                        const RunOptions& options) {
  std::vector<RunOptions> all;
  for (const std::string& log : logs) {
    RunOptions one = options;
    one.log = log;
    one.output = (fs::path(options.output) / std::to_string(all.size() + 1)).string();
    all.push_back(std::move(one));
  }
  return all;
}

void prepare_folders(const std::vector<RunOptions>& logs, const RunOptions& options) {
  for (const RunOptions& log : logs) {
    require_writable_folder(log.output);
    require_own_results({log.output, learns_camera(log), inputs_of(log)});
  }
  require_own_results({options.output, false, inputs_of(options)});
  clear_of_earlier_run(options.output);
  for (const RunOptions& log : logs) {
    require_writable_folder(log.output);  // anew: an earlier run's empty folders went
    clear_of_earlier_run(log.output);
  }
}

/// A log that was driven.
struct Driven {
  RunOptions options;
  DriveRecord record;
  double wall_seconds = 0.0;
};

std::vector<Driven> drive_all(const std::vector<RunOptions>& logs) {
  std::vector<Driven> all;
  for (const RunOptions& log : logs) {
    if (!all.empty() && interrupted()) break;
    const auto start = std::chrono::steady_clock::now();
    Driven one{log, run_drive(log, {}), 0.0};
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    one.wall_seconds = wall.count();
    all.push_back(std::move(one));
  }
  return all;
}

/// Those of logs that nothing was driven of.
void remove_empty_folders(const std::vector<RunOptions>& logs) {
  for (const RunOptions& log : logs) {
    std::error_code not_empty;
    fs::remove(log.output, not_empty);
  }
}

void write_all(std::vector<Driven>& driven, const std::vector<RecordedDrive>& drives,
               const ClosedDrives& closed, const std::string& folder, double wall_seconds) {
  for (std::size_t i = 0; i < driven.size(); ++i) {
    Driven& log = driven[i];
    const ClosedDrive& drive = closed.drives[i];
    tell_notes(log.record, &drive, log.options);
    if (log.record.frames.empty()) continue;
    std::cout << printable(log.options.log) << ":\n";
    write_results(log.record, &drive, log.options, log.wall_seconds);
  }
  write_closed_drives(drives, closed, folder);
  write_file_atomically(fs::path(folder) / "summary.json",
                        logs_summary_json(drives, closed, wall_seconds));
  write_file_atomically(fs::path(folder) / "report.html", logs_report_html(drives, closed));
  const bool metric = drives.front().record->has_scale();
  write_file_atomically(fs::path(folder) / "files.json", manifest_json(folder, metric));
  std::cout << text_about_logs(drives, closed) << "written to " << printable(folder) << ": "
            << names_of_results(folder) << '\n';
  if (drives.front().options->run.quiet) return;
  for (const std::string& line : about_logs_apart(drives, closed)) {
    std::cerr << "oneac: " << printable(line) << '\n';
  }
}

}  // namespace

void run_logs(const std::vector<std::string>& logs, const RunOptions& options) {
  require_logs_that_can_be_joined(logs, options);
  const std::vector<RunOptions> each = options_of_logs(logs, options);
  require_one_camera(each);
  prepare_folders(each, options);
  catch_interrupts();
  const auto start = std::chrono::steady_clock::now();
  std::vector<Driven> driven = drive_all(each);
  std::vector<RecordedDrive> drives;
  drives.reserve(driven.size());
  for (const Driven& log : driven) drives.push_back({&log.record, &log.options});
  const ClosedDrives closed = close_loops(drives);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  for (Driven& log : driven) log.record.interrupted = log.record.interrupted || interrupted();
  write_all(driven, drives, closed, options.output, wall.count());
  remove_empty_folders(each);
  for (const Driven& log : driven) {
    fail_if_empty(log.record, log.options.log);
    fail_if_incomplete(log.record);
  }
}

}  // namespace oneac::app
