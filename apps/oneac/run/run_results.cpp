#include "run_results.h"

#include "result_files.h"
#include "run_georeference.h"
#include "run_outputs.h"
#include "run_report.h"
#include "run_summary.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/printable.h"

#include <filesystem>
#include <iostream>
#include <string>

namespace oneac::app {

bool learns_camera(const RunOptions& options) {
  return options.front_end.self_calibration.refine != "off";
}

void write_results(const DriveRecord& record, const ClosedDrive* closed, RunOptions& options,
                   double wall_seconds) {
  const std::filesystem::path folder(options.output);
  write_drive(record, folder);
  if (closed != nullptr) write_closed_drive(record, *closed, folder);
  const std::string camera =
      learns_camera(options) ? used_camera_ini(record, options.log) : std::string();
  if (!camera.empty()) write_file_atomically(folder / "camera.ini", camera);
  write_file_atomically(folder / "params.yaml", options.result_parameters());
  const RunEvaluation evaluation = evaluate_record(record, options, closed);
  if (!evaluation.reference_fault.empty()) {
    std::cerr << "oneac: not compared with what lies beside the log: "
              << printable(evaluation.reference_fault) << '\n';
  }
  const GeoreferenceResult& joined = evaluation.georeference;
  write_georeferenced(record, joined, options.run.georeference, folder);
  if (options.run.georeference && !joined.found && !options.run.quiet) {
    std::cerr << "oneac: the drive is not joined to the GPS: " << printable(joined.reason) << '\n';
  }
  const std::string summary = summary_json(record, evaluation, options, wall_seconds, closed);
  write_file_atomically(folder / "summary.json", summary);
  write_file_atomically(folder / "report.html",
                        report_html(record, evaluation, options, summary, closed));
  write_file_atomically(folder / "files.json", manifest_json(folder, record.has_scale()));
  std::cout << summary_text(record, evaluation)
            << (closed != nullptr ? text_about(*closed, evaluation.closed_against_poses) : "")
            << "written to " << printable(options.output) << ": " << names_of_results(folder)
            << '\n';
}

void tell_notes(const DriveRecord& record, const ClosedDrive* closed, const RunOptions& options) {
  if (options.run.quiet) return;
  for (const std::string& note : notes_about(record)) {
    std::cerr << "oneac: " << printable(note) << '\n';
  }
  if (closed != nullptr && !closed->note.empty()) {
    std::cerr << "oneac: " << printable(closed->note) << '\n';
  }
}

}  // namespace oneac::app
