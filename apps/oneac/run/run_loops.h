#pragma once

#include "drive_record.h"
#include "run_options.h"

#include "oneac/evaluation/evaluate.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/loops/loop_closer.h"
#include "oneac/loops/pose_graph.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace oneac::app {

/// A drive with its loops closed.
struct ClosedDrive {
  std::vector<LoopKeyframe> keyframes;  ///< of the record, as the odometry left them
  LoopReport report;
  ClosedGraph graph;
  std::vector<Eigen::Isometry3d> frames;  ///< T_first_cam of every processed frame, closed
  std::string note;  ///< one line when the images could not be read again, else ""

  /// The record's trajectories with the closed poses.
  [[nodiscard]] Trajectory camera_trajectory(const DriveRecord& record) const;
  [[nodiscard]] Trajectory vehicle_trajectory(const DriveRecord& record) const;
  /// The record's keyframes with the closed poses; their points moved along.
  [[nodiscard]] std::vector<Keyframe> moved_keyframes(const DriveRecord& record) const;
};

/// Reads the keyframes' images of the log once more, finds loops and closes the drive by them. What
/// cannot be read again, or was interrupted, ends without loops.
[[nodiscard]] ClosedDrive close_loops(const DriveRecord& record, const RunOptions& options);

/// Behind write_drive(): loops.csv, the optimised trajectories and keyframes, loops as edges in
/// graph.g2o, map.simplemap and points.ply of the closed drive; each whole or not at all.
void write_closed_drive(const DriveRecord& record, const ClosedDrive& closed,
                        const std::filesystem::path& folder);

/// The line about loops that `oneac run` prints, with the APE after them.
/// @param after  of the closed trajectory; empty without a reference
[[nodiscard]] std::string text_about(const ClosedDrive& closed,
                                     const std::optional<Evaluation>& after);

}  // namespace oneac::app
