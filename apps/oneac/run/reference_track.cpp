#include "reference_track.h"

#include "oneac/evaluation/association.h"
#include "oneac/evaluation/trajectory_io.h"

namespace oneac::app {

ReferenceTrack reference_track(const DriveRecord& record, const RunEvaluation& evaluation) {
  ReferenceTrack track;
  if (!evaluation.against_poses) return track;
  const Trajectory reference = read_trajectory(evaluation.reference_file);
  std::vector<double> times;
  for (const FrameResult& frame : record.frames) times.push_back(frame.time_s);
  const double tolerance = time_tolerance(times);
  track.poses.resize(record.frames.size());
  std::size_t i = 0;
  for (const FrameResult& frame : record.frames) {
    std::optional<std::size_t> row = frame.index;
    if (reference.has_times()) row = nearest_row(reference.times, times[i], tolerance);
    if (row && *row < reference.poses.size()) track.poses[i] = reference.poses[*row];
    ++i;
  }
  return track;
}

}  // namespace oneac::app
