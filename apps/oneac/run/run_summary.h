#pragma once

#include "drive_record.h"
#include "run_loops.h"
#include "run_options.h"

#include "oneac/evaluation/evaluate.h"
#include "oneac/evaluation/georeference.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace oneac::app {

/// What the log's GPS says against the estimate, over the processed frames.
struct GpsComparison {
  std::optional<double> heading_change;   ///< [rad] counter-clockwise positive
  double estimated_heading_change = 0.0;  ///< [rad]
  std::optional<double> distance;         ///< [m] integrated speed
  double estimated_distance = 0.0;        ///< [m]
};

/// A run compared with what is known about the drive.
struct RunEvaluation {
  std::string reference_file;   ///< "" when there is none
  std::string reference_fault;  ///< what keeps one that lies beside the log from being read
  std::optional<Evaluation> against_poses;
  std::optional<Evaluation> closed_against_poses;  ///< the same with the loops closed
  std::optional<Evaluation> graph_against_poses;  ///< before the global adjustment, if there is one
  std::optional<GpsComparison> against_gps;
  std::optional<double> gps_lag_s;  ///< see lag_of_gps
  GeoreferenceResult georeference;  ///< how the drive lies on the earth, or why that is not known
};

/// Compares with --reference, else with poses found beside the log (`<base>_poses.txt`,
/// `poses.txt`), and with the log's GPS. @throws InputError when --reference cannot be read
[[nodiscard]] RunEvaluation evaluate_record(const DriveRecord& record, const RunOptions& options,
                                            const ClosedDrive* closed = nullptr);

/// `global_ba` of summary.json.
[[nodiscard]] nlohmann::ordered_json global_json(const GlobalReport& global);

/// summary.json; with `loops` where they were looked for. Only the object "timing" may differ
/// between runs of the same input and parameters.
[[nodiscard]] std::string summary_json(const DriveRecord& record, const RunEvaluation& evaluation,
                                       const RunOptions& options, double wall_seconds,
                                       const ClosedDrive* closed = nullptr);

/// The few lines that `oneac run` prints.
[[nodiscard]] std::string summary_text(const DriveRecord& record, const RunEvaluation& evaluation);

}  // namespace oneac::app
