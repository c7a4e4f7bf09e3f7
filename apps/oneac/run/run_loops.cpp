#include "run_loops.h"

#include "odometry_edges.h"
#include "terminal/interrupt.h"
#include "terminal/progress_bar.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/number_text.h"
#include "oneac/base/ordered_pipeline.h"
#include "oneac/frontend/map_formats.h"
#include "oneac/geometry/levelling.h"
#include "oneac/loops/loop_formats.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace oneac::app {
namespace {

LoopKeyframe to_loop_keyframe(const Keyframe& keyframe, const DriveRecord& record) {
  LoopKeyframe out;
  out.id = keyframe.id;
  out.index = keyframe.index;
  out.time_s = keyframe.time_s;
  out.segment = keyframe.segment;
  out.metric = keyframe.metric;
  out.T_first_cam = keyframe.T_first_cam;
  const auto& step = record.frames.at(keyframe.frame).step;
  out.scale_sigma = step && step->metric ? step->length_sigma : record.common_length_sigma;
  return out;
}

LoopCamera camera_of(const DriveRecord& record, const RunOptions& options) {
  LoopCamera camera;
  camera.camera = record.camera;
  const bool learned = options.front_end.self_calibration.refine != "off";
  if (learned) camera.camera = record.camera_belief.used;
  camera.R_level_cam = levelling_rotation(record.tilt);
  camera.unused = record.car_mask;
  camera.mask_polygon = options.front_end.features.mask.polygon;
  camera.mask_image = options.front_end.features.mask.image;
  return camera;
}

/// Features whose centre the mask uses.
AffineFeatures outside(const GreyImage& mask, AffineFeatures features) {
  if (mask.empty()) return features;
  constexpr std::uint8_t kUsed = 128;
  AffineFeatures kept;
  kept.descriptors.resize(features.descriptors.rows(), Eigen::NoChange);
  for (std::size_t i = 0; i < features.frames.size(); ++i) {
    const Eigen::Vector2d& u = features.frames[i].centre;
    const int column = std::clamp(static_cast<int>(std::lround(u.x())), 0, mask.width() - 1);
    const int row = std::clamp(static_cast<int>(std::lround(u.y())), 0, mask.height() - 1);
    if (mask.row(row)[column] < kUsed) continue;
    kept.descriptors.row(static_cast<Eigen::Index>(kept.frames.size())) =
        features.descriptors.row(static_cast<Eigen::Index>(i));
    kept.frames.push_back(features.frames[i]);
  }
  kept.descriptors.conservativeResize(static_cast<Eigen::Index>(kept.frames.size()),
                                      Eigen::NoChange);
  return kept;
}

/// The log once more, for the images of keyframes alone.
class KeyframeImages {
 public:
  KeyframeImages(const std::vector<LoopKeyframe>& keyframes, const RunOptions& options)
      : keyframes_(keyframes), source_(source_options(options)) {
    std::map<std::size_t, std::size_t> places;
    for (std::size_t i = 0; i < keyframes.size(); ++i) places[keyframes[i].index] = i;
    tickets_.resize(keyframes.size());
    std::size_t found = 0;
    while (found < places.size() && !interrupted()) {
      const auto ticket = source_.next();
      if (!ticket) return;
      const auto at = places.find(ticket->index);
      if (at == places.end()) continue;
      tickets_[at->second] = *ticket;
      ++found;
    }
  }

  /// Any thread. @throws InputError where the image has gone
  [[nodiscard]] CameraFrame load(std::size_t place) const {
    return tickets_[place] ? source_.load(*tickets_[place]) : CameraFrame{};
  }

 private:
  static SourceOptions source_options(const RunOptions& options) {
    SourceOptions source = options.source.for_log(options.log);
    source.camera_model = options.camera_model;
    return source;
  }

  const std::vector<LoopKeyframe>& keyframes_;
  RawlogSource source_;
  std::vector<std::optional<FrameTicket>> tickets_;
};

FoundLoops find_loops(const std::vector<LoopKeyframe>& keyframes, const DriveRecord& record,
                      const RunOptions& options) {
  const KeyframeImages images(keyframes, options);
  LoopCloser closer(options.loops, camera_of(record, options),
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
    return outside(frame.mask, closer.features(frame.image.view()));
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
    const Eigen::Isometry3d& T = record.frames[i].T_first_cam;
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
      const double share = end > begin ? (record.frames[i].time_s - begin) / (end - begin) : 0.0;
      frames.push_back(blended(by(next - 1), by(next), std::clamp(share, 0.0, 1.0)));
    }
  }
  return frames;
}

}  // namespace

Trajectory ClosedDrive::camera_trajectory(const DriveRecord& record) const {
  Trajectory trajectory = record.camera_trajectory();
  trajectory.poses = frames;
  return trajectory;
}

Trajectory ClosedDrive::vehicle_trajectory(const DriveRecord& record) const {
  const Eigen::Isometry3d T = record.mount();
  Trajectory trajectory = camera_trajectory(record);
  for (Eigen::Isometry3d& pose : trajectory.poses) pose = T * pose * T.inverse();
  return trajectory;
}

std::vector<Keyframe> ClosedDrive::moved_keyframes(const DriveRecord& record) const {
  std::vector<Keyframe> moved = record.keyframes;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Eigen::Isometry3f move =
        (graph.T_first_cam[i] * moved[i].T_first_cam.inverse()).cast<float>();
    moved[i].T_first_cam = graph.T_first_cam[i];
    for (MapPoint& point : moved[i].points) {
      point.position = move * point.position;
      point.normal = move.linear() * point.normal;
    }
  }
  return moved;
}

ClosedDrive close_loops(const DriveRecord& record, const RunOptions& options) {
  ClosedDrive closed;
  for (const Keyframe& keyframe : record.keyframes) {
    closed.keyframes.push_back(to_loop_keyframe(keyframe, record));
    if (closed.keyframes.size() == 1) continue;
    const Keyframe& before = record.keyframes[closed.keyframes.size() - 2];
    closed.keyframes.back().covariance = covariance_between(before, keyframe, record);
  }
  FoundLoops found;
  try {
    if (!closed.keyframes.empty() && !interrupted()) {
      found = find_loops(closed.keyframes, record, options);
    }
  } catch (const InputError& error) {
    closed.note = std::string("no loops: the images could not be read again: ") + error.what();
    found = {};
  }
  closed.report = found.report;
  closed.graph = optimise_pose_graph(closed.keyframes, found.loops);
  closed.report.contradicted += found.loops.size() - closed.graph.loops.size();
  closed.frames = closed.graph.loops.empty() ? record.camera_trajectory().poses
                                             : moved_frames(record, closed.graph.T_first_cam);
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
  if (record.keyframes.empty()) return;
  DriveRecord moved;
  moved.keyframes = closed.moved_keyframes(record);
  write("keyframes_optimised.tum", format_tum(moved.keyframe_trajectory()));
  write("graph.g2o", format_g2o(keyframes_by_steps(record)) +
                         format_g2o_loops(closed.graph.loops, closed.keyframes));
  write_file_atomically(folder / "points.ply",
                        [&](std::ostream& out) { write_ply(moved.keyframes, out); });
  write("map.simplemap", format_simple_map(moved.keyframes, record.mount(), record.camera));
}

std::string text_about(const ClosedDrive& closed, const std::optional<Evaluation>& after) {
  std::string text = std::to_string(closed.graph.loops.size()) + " loops of " +
                     std::to_string(closed.report.keyframes) + " keyframes";
  if (closed.report.not_metric > 0) {
    text +=
        " (" + std::to_string(closed.report.not_metric) + " of them without metres: none there)";
  }
  if (after && after->trajectory && !closed.graph.loops.empty()) {
    text += ", APE after them " + significant_text(after->trajectory->ape.rmse, 3) + " m (RMS)";
  }
  return text + '\n';
}

}  // namespace oneac::app
