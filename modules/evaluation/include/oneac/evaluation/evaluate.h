#pragma once

#include "oneac/evaluation/pair_errors.h"
#include "oneac/evaluation/relative_poses_io.h"
#include "oneac/evaluation/time_alignment.h"
#include "oneac/evaluation/trajectory_errors.h"
#include "oneac/evaluation/trajectory_io.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// Pair errors, trajectory errors, or both.
struct Evaluation {
  std::vector<PairError> pairs;             ///< in the order of the estimate
  std::optional<PairSummary> pair_summary;  ///< empty when pairs were not asked for
  std::optional<TrajectoryErrors> trajectory;
  std::size_t estimate_frames = 0;   ///< rows of the estimated trajectory, matched or not
  std::size_t reference_frames = 0;  ///< rows of the reference
  std::optional<double> offset_s;    ///< that was added to the estimate's times, where asked for
  std::vector<std::string> notes;    ///< what was made of files and times, one line each
};

/// Errors of each pair that has a reference. The reference pose of an image is the row that its
/// index names, or, when the reference has times, that of its time (see resampled()).
/// @param reference  T_world_camera, camera optical frame [m]
[[nodiscard]] Evaluation evaluate_pairs(const std::vector<RelativePoseRow>& rows,
                                        const Trajectory& reference,
                                        const TimeAlignment& time = {});

/// All that a run can say about itself: evaluate_pairs, and the trajectory's errors with its rows
/// associated by the pairs' indices or times. No trajectory errors when nothing is associated.
/// @param rows      of consecutive processed frames, one chain; may be none
/// @param estimate  one pose per processed frame
/// @throws std::invalid_argument when the rows are not one chain or do not fit the estimate
[[nodiscard]] Evaluation evaluate_run(const std::vector<RelativePoseRow>& rows,
                                      const Trajectory& estimate, const Trajectory& reference,
                                      Alignment alignment = Alignment::kSe3);

/// Errors of a trajectory without its pairs. Rows are associated by time when both have times, else
/// row by row when they are as many.
/// @throws std::invalid_argument when rows cannot be told to belong together, or none do
[[nodiscard]] Evaluation evaluate_trajectory(const Trajectory& estimate,
                                             const Trajectory& reference,
                                             Alignment alignment = Alignment::kSe3);

/// What `oneac eval` is asked.
struct EvaluationRequest {
  std::filesystem::path estimate;   ///< relative_poses.csv, or a KITTI or TUM trajectory
  std::filesystem::path reference;  ///< any form that read_trajectory_file() knows
  Alignment alignment = Alignment::kSe3;
  bool pairs = false;  ///< of a trajectory: its consecutive rows as pairs too
  TimeAlignment time = {};
  bool estimate_offset = false;  ///< see estimated_offset(); instead of time.offset_s
};

/// Reads both files and compares them.
///
/// Rows are associated by time when both have times; otherwise row by row when they are as many;
/// otherwise by a relative_poses.csv beside the estimate, whose pairs say which image of the log
/// each row shows (or when it was taken).
/// @throws InputError naming file, fault and cure
[[nodiscard]] Evaluation evaluate_files(const EvaluationRequest& request);

}  // namespace oneac
