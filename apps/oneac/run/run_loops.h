#pragma once

#include "drive_record.h"
#include "run_options.h"

#include "oneac/evaluation/evaluate.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/loops/global_adjustment.h"
#include "oneac/loops/loop_closer.h"
#include "oneac/loops/pose_graph.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace oneac::app {

/// A drive with its loops closed, alone or together with those of other logs.
struct ClosedDrive {
  std::vector<LoopKeyframe> keyframes;    ///< of the record, as the odometry left them
  LoopReport report;                      ///< of the search, which may be in several logs
  ClosedGraph graph;                      ///< its own keyframes and the loops between them
  std::vector<Eigen::Isometry3d> frames;  ///< T_first_cam of every processed frame, closed
  /// The same by the pose graph alone; empty where nothing was adjusted after it
  std::vector<Eigen::Isometry3d> frames_of_graph;
  /// Of (θ, p) of each keyframe in that frame, see closed_covariances(); empty without loops
  std::vector<Eigen::Matrix<double, 6, 6>> covariances;
  Eigen::Isometry3d frame_mount = Eigen::Isometry3d::Identity();  ///< T_vehicle_cam of that first
  std::string note;                   ///< one line when the images could not be read again, else ""
  std::size_t log = 0, frame_of = 0;  ///< which of the logs, and whose first camera the frame is
  std::size_t loops_to_others = 0;    ///< loops that end in another log
  bool alone = true;                  ///< the only log
  bool searched = false;              ///< for loops, to the end
  std::optional<GlobalReport> global;  ///< of all logs; empty when it was not asked for
  /// Of the record's map points, in their order, where the global adjustment has put them.
  std::vector<std::optional<Eigen::Vector3d>> points;

  /// The record's trajectories with the closed poses.
  [[nodiscard]] Trajectory camera_trajectory(const DriveRecord& record) const;
  [[nodiscard]] Trajectory vehicle_trajectory(const DriveRecord& record) const;
  /// The record's keyframes with the closed poses; their points moved along.
  [[nodiscard]] std::vector<Keyframe> moved_keyframes(const DriveRecord& record) const;
};

/// A drive, and how its log is read.
struct RecordedDrive {
  const DriveRecord* record = nullptr;
  const RunOptions* options = nullptr;
};

/// Drives of several logs, closed together.
struct ClosedDrives {
  std::vector<LoopKeyframe> keyframes;  ///< of all, one log after the other
  LoopReport report;
  ClosedGraph graph;                                     ///< of all
  std::vector<Eigen::Matrix<double, 6, 6>> covariances;  ///< see ClosedDrive, of all
  bool searched = false;                                 ///< to the end
  std::vector<ClosedDrive> drives;     ///< each for itself, in the frame that it was joined to
  std::optional<GlobalReport> global;  ///< of the global adjustment, where it was asked for
  std::vector<Eigen::Isometry3d> T_of_graph;  ///< what it began with; empty: it changed nothing
  std::vector<std::vector<std::optional<Eigen::Vector3d>>> points;  ///< per log, see ClosedDrive
  std::string note;  ///< one line when the images could not be read again, else ""
};

/// The camera in which images are compared: as the drive has learned it.
[[nodiscard]] PinholeCamera camera_of_loops(const DriveRecord& record, const RunOptions& options);

/// Reads the keyframes' images of the logs once more, finds loops in each and between them, and
/// closes the drives by them. What cannot be read again, or was interrupted, ends without loops.
/// @pre one camera took all of them
[[nodiscard]] ClosedDrives close_loops(const std::vector<RecordedDrive>& drives);

/// Behind write_drive(): loops.csv, the optimised trajectories and keyframes, loops as edges in
/// graph.g2o, map.simplemap and points.ply of the closed drive; each whole or not at all.
void write_closed_drive(const DriveRecord& record, const ClosedDrive& closed,
                        const std::filesystem::path& folder);

/// loops.csv and graph.g2o of all drives, map.simplemap and points.ply of those in the frame of the
/// first; each whole or not at all.
void write_closed_drives(const std::vector<RecordedDrive>& drives, const ClosedDrives& closed,
                         const std::filesystem::path& folder);

/// How the global adjustment came out, in a few words.
[[nodiscard]] std::string text_about(const GlobalReport& global);

/// The line about loops that `oneac run` prints, with the APE after them.
/// @param after  of the closed trajectory; empty without a reference
[[nodiscard]] std::string text_about(const ClosedDrive& closed,
                                     const std::optional<Evaluation>& after);

}  // namespace oneac::app
