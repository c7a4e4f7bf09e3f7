#include "run_loops.h"

#include "closed_covariances.h"
#include "keyframe_images.h"
#include "odometry_edges.h"
#include "run_global.h"
#include "terminal/interrupt.h"
#include "terminal/progress_bar.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/number_text.h"
#include "oneac/base/ordered_pipeline.h"
#include "oneac/frontend/map_formats.h"
#include "oneac/frontend/trajectory_uncertainty.h"
#include "oneac/geometry/levelling.h"
#include "oneac/loops/graph_covariance.h"
#include "oneac/loops/loop_formats.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace oneac::app {
namespace {

/// The keyframes of the drives, one log after the other, each with an id of its own.
std::vector<LoopKeyframe> loop_keyframes(const std::vector<RecordedDrive>& drives) {
  std::vector<LoopKeyframe> all;
  for (std::size_t log = 0; log < drives.size(); ++log) {
    const DriveRecord& record = *drives[log].record;
    const std::size_t first_id = all.empty() ? 0 : all.back().id + 1;
    Keyframe before;
    for (std::size_t i = 0; i < record.keyframes.size(); ++i) {
      Keyframe now = record.keyframes[i];
      LoopKeyframe keyframe = to_loop_keyframe(now, i > 0 ? &before : nullptr, steps_of(record),
                                               record.common_length_sigma);
      keyframe.log = log;
      if (const auto place = record.source.reference.place(keyframe.time_s)) {
        keyframe.place = GpsPlace{place->point, place->course};
      }
      keyframe.id += first_id;
      all.push_back(keyframe);
      before = std::move(now);
    }
  }
  return all;
}

LoopCamera camera_of(const DriveRecord& record, const RunOptions& options) {
  LoopCamera camera;
  camera.camera = camera_of_loops(record, options);
  camera.R_level_cam = levelling_rotation(record.tilt);
  camera.unused = record.car_mask;
  camera.mask_polygon = options.front_end.features.mask.polygon;
  camera.mask_image = options.front_end.features.mask.image;
  return camera;
}

/// The largest of the logs': one car, one camera.
SharedErrors shared_errors(const std::vector<RecordedDrive>& drives) {
  SharedErrors shared;
  for (const RecordedDrive& drive : drives) {
    shared.length = std::max(shared.length, drive.record->common_length_sigma);
    shared.turn = std::max(shared.turn, shared_turn_sigma(drive.record->camera_belief.doubt));
  }
  return shared;
}

/// @pre there are keyframes
FoundLoops find_loops(const std::vector<LoopKeyframe>& keyframes,
                      const std::vector<RecordedDrive>& drives) {
  const RunOptions& options = *drives.front().options;
  const KeyframeImages images(drives);
  const DriveRecord& first = *drives[keyframes.front().log].record;
  LoopOptions search = options.loops;
  search.keep_patches = options.run.global_ba;
  LoopCloser closer(search, camera_of(first, options),
                    [&](std::size_t place) { return images.load(place).image; });
  ProgressBar progress(options.run.progress && !options.run.quiet, "keyframes");
  progress.expect(keyframes.size());
  std::size_t at = 0, added = 0;
  const auto next = [&]() -> std::optional<std::size_t> {
    return at == keyframes.size() || interrupted() ? std::nullopt : std::optional(at++);
  };
  const auto detect = [&](std::size_t place) {
    const CameraFrame frame = images.load(place);
    if (frame.image.empty()) return AffineFeatures{};
    return closer.features(frame.image.view(), frame.mask.view());
  };
  const auto add = [&](const AffineFeatures& features) {
    closer.add(keyframes[added++], features);
    progress.update(added);
    return true;
  };
  ordered_pipeline(next, detect, add, options.run.threads);
  return interrupted() ? FoundLoops{} : closer.close(options.run.threads, interrupted);
}

/// Between two keyframes a frame moves by what both do, by its share of the time between them.
Eigen::Isometry3d blended(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double share) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(a.linear()).slerp(share, Eigen::Quaterniond(b.linear())).matrix();
  T.translation() = (1.0 - share) * a.translation() + share * b.translation();
  return T;
}

/// The frames where the closed keyframes bring them. @pre there are keyframes
std::vector<Eigen::Isometry3d> moved_frames(const DriveRecord& record,
                                            const std::vector<Eigen::Isometry3d>& closed) {
  std::vector<Eigen::Isometry3d> frames;
  const auto& keyframes = record.keyframes;
  std::size_t next = 0;
  for (std::size_t i = 0; i < record.frames.size(); ++i) {
    const FrameResult frame = record.frames[i];
    const Eigen::Isometry3d& T = frame.T_first_cam;
    while (next < keyframes.size() && keyframes[next].frame <= i) ++next;
    const auto by = [&](std::size_t k) {
      return closed[k] * keyframes[k].T_first_cam.inverse() * T;
    };
    if (next == 0) {
      frames.push_back(by(0));
    } else if (next == keyframes.size()) {
      frames.push_back(by(next - 1));
    } else {
      const double begin = keyframes[next - 1].time_s, end = keyframes[next].time_s;
      const double share = end > begin ? (frame.time_s - begin) / (end - begin) : 0.0;
      frames.push_back(blended(by(next - 1), by(next), std::clamp(share, 0.0, 1.0)));
    }
  }
  return frames;
}

/// One log of several: its keyframes [begin, end), and the loops that begin and end there.
ClosedDrive drive_of(const ClosedDrives& all, std::size_t begin, std::size_t end,
                     const std::vector<RecordedDrive>& drives, std::size_t log) {
  const DriveRecord& record = *drives[log].record;
  ClosedDrive drive;
  drive.log = log;
  drive.frame_of = begin == end ? log : all.keyframes[all.graph.group[begin]].log;
  drive.alone = drives.size() == 1;
  drive.searched = all.searched;
  drive.report = all.report;
  drive.note = all.note;
  drive.global = all.global;
  if (!all.points.empty()) drive.points = all.points[log];
  drive.frame_mount = drives[drive.frame_of].record->mount();
  for (std::size_t i = begin; i < end; ++i) {
    drive.keyframes.push_back(all.keyframes[i]);
    drive.keyframes.back().log = 0;
    drive.keyframes.back().id = record.keyframes[i - begin].id;
    drive.graph.T_first_cam.push_back(all.graph.T_first_cam[i]);
    drive.graph.group.push_back(0);
  }
  const auto is_own = [&](std::size_t keyframe) { return keyframe >= begin && keyframe < end; };
  for (LoopConstraint loop : all.graph.loops) {
    const bool first = is_own(loop.first), second = is_own(loop.second);
    if (first != second) ++drive.loops_to_others;
    if (!first || !second) continue;
    loop.first -= begin;
    loop.second -= begin;
    drive.graph.loops.push_back(loop);
  }
  const bool moved = !drive.graph.loops.empty() || drive.loops_to_others > 0;
  if (moved) {
    drive.covariances.assign(all.covariances.begin() + static_cast<std::ptrdiff_t>(begin),
                             all.covariances.begin() + static_cast<std::ptrdiff_t>(end));
  }
  drive.frames =
      moved ? moved_frames(record, drive.graph.T_first_cam) : record.camera_trajectory().poses;
  if (moved && !all.T_of_graph.empty()) {
    const auto at = all.T_of_graph.begin();
    drive.frames_of_graph = moved_frames(
        record, {at + static_cast<std::ptrdiff_t>(begin), at + static_cast<std::ptrdiff_t>(end)});
  }
  return drive;
}

}  // namespace

PinholeCamera camera_of_loops(const DriveRecord& record, const RunOptions& options) {
  const bool learned = options.front_end.self_calibration.refine != "off";
  return learned ? record.camera_belief.used : record.camera;
}

Trajectory ClosedDrive::camera_trajectory(const DriveRecord& record) const {
  Trajectory trajectory = record.camera_trajectory();
  trajectory.poses = frames;
  return trajectory;
}

Trajectory ClosedDrive::vehicle_trajectory(const DriveRecord& record) const {
  const Eigen::Isometry3d T = record.mount();
  Trajectory trajectory = camera_trajectory(record);
  for (Eigen::Isometry3d& pose : trajectory.poses) pose = frame_mount * pose * T.inverse();
  return trajectory;
}

std::vector<Keyframe> ClosedDrive::moved_keyframes(const DriveRecord& record) const {
  std::vector<Keyframe> moved;
  std::size_t at = 0;
  for (std::size_t i = 0; i < record.keyframes.size(); ++i) {
    moved.push_back(record.keyframes[i]);
    moved[i].points = record.keyframes.points(i);
    const Eigen::Isometry3f move =
        (graph.T_first_cam[i] * moved[i].T_first_cam.inverse()).cast<float>();
    moved[i].T_first_cam = graph.T_first_cam[i];
    for (MapPoint& point : moved[i].points) {
      point.position = move * point.position;
      point.normal = move.linear() * point.normal;
      const bool adjusted = at < points.size() && points[at];
      if (adjusted) point.position = points[at]->cast<float>();
      ++at;
    }
  }
  return moved;
}

ClosedDrives close_loops(const std::vector<RecordedDrive>& drives) {
  ClosedDrives closed;
  closed.keyframes = loop_keyframes(drives);
  FoundLoops found;
  try {
    if (!closed.keyframes.empty() && !interrupted()) found = find_loops(closed.keyframes, drives);
    closed.searched = !interrupted();
  } catch (const InputError& error) {
    closed.note = std::string("no loops: the images could not be read again: ") + error.what();
    found = {};
  }
  closed.report = found.report;
  closed.graph = optimise_pose_graph(closed.keyframes, found.loops);
  closed.report.contradicted += found.loops.size() - closed.graph.loops.size();
  if (drives.front().options->run.global_ba) adjust_closed_drives(drives, closed);
  if (!closed.graph.loops.empty()) {
    closed.covariances = closed_covariances(closed.keyframes, closed.graph, shared_errors(drives));
  }
  std::size_t begin = 0;
  for (std::size_t log = 0; log < drives.size(); ++log) {
    const std::size_t end = begin + drives[log].record->keyframes.size();
    closed.drives.push_back(drive_of(closed, begin, end, drives, log));
    begin = end;
  }
  return closed;
}

void write_closed_drive(const DriveRecord& record, const ClosedDrive& closed,
                        const std::filesystem::path& folder) {
  const Trajectory camera = closed.camera_trajectory(record);
  const auto write = [&](const char* name, const std::string& text) {
    write_file_atomically(folder / name, text);
  };
  write("loops.csv", format_loops(closed.graph.loops, closed.keyframes));
  write("trajectory_optimised_camera.kitti", format_kitti(camera));
  write("trajectory_optimised_camera.tum", format_tum(camera));
  write("trajectory_optimised_vehicle.tum", format_tum(closed.vehicle_trajectory(record)));
  write("trajectory_optimised_camera.csv",
        format_pose_covariances(closed_camera_poses(record, closed)));
  write("trajectory_optimised_vehicle.csv",
        format_pose_covariances(closed_vehicle_poses(record, closed)));
  if (record.keyframes.empty()) return;
  const std::vector<Keyframe> moved = closed.moved_keyframes(record);
  write_file_atomically(folder / "keyframes_optimised.tum",
                        [&](std::ostream& out) { write_keyframes(moved, out); });
  write("graph.g2o", format_g2o(keyframes_by_steps(record)) +
                         format_g2o_loops(closed.graph.loops, closed.keyframes));
  write_file_atomically(folder / "points.ply", [&](std::ostream& out) { write_ply(moved, out); });
  write("map.simplemap", format_simple_map(moved, record.mount(), record.camera));
}

void write_closed_drives(const std::vector<RecordedDrive>& drives, const ClosedDrives& closed,
                         const std::filesystem::path& folder) {
  write_file_atomically(folder / "loops.csv", format_loops(closed.graph.loops, closed.keyframes));
  std::string graph;
  std::vector<Keyframe> together;
  std::size_t begin = 0;
  for (std::size_t log = 0; log < drives.size(); ++log) {
    const DriveRecord& record = *drives[log].record;
    const ClosedDrive& drive = closed.drives[log];
    std::vector<Keyframe> chain = keyframes_by_steps(record);
    for (std::size_t i = 0; i < chain.size(); ++i) {
      chain[i].id = closed.keyframes[begin + i].id;
      chain[i].T_first_cam = drive.graph.T_first_cam.front() *
                             record.keyframes[0].T_first_cam.inverse() *
                             record.keyframes[i].T_first_cam;
    }
    graph += format_g2o(chain);
    begin += chain.size();
    if (drive.frame_of != 0) continue;
    const std::vector<Keyframe> moved = drive.moved_keyframes(record);
    together.insert(together.end(), moved.begin(), moved.end());
  }
  write_file_atomically(folder / "graph.g2o",
                        graph + format_g2o_loops(closed.graph.loops, closed.keyframes));
  const DriveRecord& first = *drives.front().record;
  write_file_atomically(folder / "points.ply",
                        [&](std::ostream& out) { write_ply(together, out); });
  write_file_atomically(folder / "map.simplemap",
                        format_simple_map(together, first.mount(), first.camera));
}

std::string text_about(const GlobalReport& global) {
  if (!global.adjusted) return "no global adjustment: " + global.reason;
  return "global adjustment of " + std::to_string(global.observations) + " observations of " +
         std::to_string(global.patches) + " patches, " + significant_text(global.rms_before_px, 3) +
         " -> " + significant_text(global.rms_after_px, 3) + " px";
}

std::string text_about(const ClosedDrive& closed, const std::optional<Evaluation>& after) {
  if (!closed.searched) return "no loops: the search for them did not come to its end\n";
  std::string text =
      std::to_string(closed.graph.loops.size()) + " loops of " +
      std::to_string(closed.alone ? closed.report.keyframes : closed.keyframes.size()) +
      " keyframes";
  if (closed.loops_to_others > 0) {
    text += ", " + std::to_string(closed.loops_to_others) + " to other logs";
  }
  if (closed.alone && closed.report.not_metric > 0) {
    text +=
        " (" + std::to_string(closed.report.not_metric) + " of them without metres: none there)";
  }
  const bool moved = !closed.graph.loops.empty() || closed.loops_to_others > 0;
  if (after && after->trajectory && moved) {
    text += ", APE after them " + significant_text(after->trajectory->ape.rmse, 3) + " m (RMS)";
  }
  if (closed.global) text += "; " + text_about(*closed.global);
  return text + '\n';
}

}  // namespace oneac::app
