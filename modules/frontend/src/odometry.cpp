#include "odometry.h"

#include "oneac/base/thread_clock.h"
#include "oneac/refine/two_view.h"

#include <Eigen/Geometry>

#include <cmath>
#include <utility>

namespace oneac {
namespace {

// [m] A sensor pose lower than this has its origin on the vehicle, not on the road: then the log
// does not tell the camera's height.
constexpr double kLowestMount = 0.5;
// Plausible speeds of a car [m/s], 250 km/h; a length beyond is refused as metric.
constexpr double kFastestCar = 70.0;

RelativePose orthonormalised(const RelativePose& T) {
  return {Eigen::Quaterniond(T.R).normalized().toRotationMatrix(), T.t};
}

Eigen::Isometry3d camera_in_first(const RelativePose& T_cam_map) {
  const RelativePose inverse = T_cam_map.inverse();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = inverse.R;
  T.translation() = inverse.t;
  return T;
}

}  // namespace

Odometry::Odometry(const FrontEndOptions& options, RelativePoseInitialiser::Ptr initialiser)
    : options_(options), initialiser_(std::move(initialiser)), scale_(options.scale) {}

FrameResult Odometry::start(const CameraFrame& frame) {
  R_vehicle_cam_ = frame.T_vehicle_cam.linear();
  tilt_.emplace(given_tilt(), options_.tilt);
  road_tilt_.emplace(tilt_->belief());
  const bool by_height = options_.scale.source == "height";
  camera_height_ = by_height ? options_.camera_height : 0.0;
  const double mount_height = by_height ? frame.T_vehicle_cam.translation().z() : 0.0;
  if (camera_height_ == 0.0 && mount_height >= kLowestMount) camera_height_ = mount_height;
  FrameResult result;
  result.index = frame.index;
  result.time_s = frame.time_s;
  if (options_.window.enabled) {
    map_.emplace(options_.window, frame.camera.focal_px());
    map_->start(0, T_cam_map_);
    result.keyframe = map_->keyframes().back().id;
    settling_.add_keyframe(*result.keyframe, {frame.index, frame.time_s, segment_, false, 0.0});
    settling_.add_frame(0, *result.keyframe, {});
    keyframe_time_ = frame.time_s;
  }
  tell_tilt(result);
  speeds_.restart(frame.time_s);
  frames_ = 1;
  previous_ = frame;
  return result;
}

FrameResult Odometry::advance(const CameraFrame& frame, StepTracks tracks) {
  FrameResult result;
  result.index = frame.index;
  result.time_s = frame.time_s;
  StepResult step;
  step.index1 = previous_.index;
  step.index2 = frame.index;
  step.time1 = previous_.time_s;
  step.time2 = frame.time_s;
  step.acs = tracks.acs.size();
  const TwoView found = estimate(tracks, frame.camera.focal_px(), step);
  step.status = found.status;
  step.pose = found.pose;
  step.inliers = found.inlier_count;
  {
    const StageTimer timer(step.refine_ms);
    follow(tracks, found, step);
    set_length(tracks, found, frame, step);
    move(step);
    update_map(frame, tracks, step, result);
  }
  step.segment = segment_;
  result.step = step;
  tell_tilt(result);
  result.T_first_cam = camera_in_first(T_cam_map_);
  result.T_first_cam.translation() += settling_.offset();
  previous_ = frame;
  ++frames_;
  return result;
}

Odometry::TwoView Odometry::estimate(StepTracks& tracks, double focal_px, StepResult& step) const {
  if (tracks.standing) {
    TwoView stands;
    stands.status = StepStatus::kNoMotion;
    stands.inliers.assign(tracks.acs.size(), true);
    stands.inlier_count = tracks.acs.size();
    return stands;
  }
  const InitialiserInput input{tracks.acs, leveling(), focal_px, options_.seed + frames_};
  InitialiserResult found;
  {
    const StageTimer timer(step.estimate_ms);
    found = initialiser_->estimate(input);
  }
  TwoView result;
  result.inlier_count = found.inlier_count;
  if (found.status == PoseStatus::kTooFew) {
    result.pose = last_motion_;
    if (result.pose.t.norm() > 0.0) result.pose.t.normalize();
    return result;
  }
  result.pose = found.pose;
  result.inliers = std::move(found.inliers);
  result.status = StepStatus::kNoMotion;
  if (is_stationary(found.status)) return result;
  result.status = StepStatus::kOk;
  if (options_.perspective) correct_perspective(found.pose, tracks);
  if (!options_.refine_enabled) return result;
  const StageTimer timer(step.refine_ms);
  const RefineResult refined =
      refine_two_view(tracks.acs, result.inliers, found.pose, focal_px, options_.refine);
  if (refined.usable()) result.pose = refined.pose;
  return result;
}

void Odometry::follow(const StepTracks& tracks, const TwoView& found, StepResult& step) {
  if (!map_) return;
  if (found.status == StepStatus::kPredicted) {
    if (map_->keyframes().empty()) restart({}, {});  // after finish()
    map_->extend({}, {});                            // nothing goes on
    lost_ = true;
    return;
  }
  if (std::exchange(lost_, false)) {
    restart(tracks, found);
    return;
  }
  map_->extend(tracks, found.inliers);
  if (found.status != StepStatus::kOk) return;
  const auto carried = map_->carry(found.pose, T_cam_map_);
  if (carried && carried->length > 0.0) {
    step.length = carried->length;
    step.length_sigma = carried->sigma;
    carried_variance_ += carried->sigma * carried->sigma;
    step.landmarks = carried->support;
  } else if (map_->keyframes().size() > 1) {
    restart(tracks, found);
  }
}

void Odometry::restart(const StepTracks& tracks, const TwoView& found) {
  settling_.settle_all(*map_, pending_);
  ++segment_;
  scale_.lose();
  carried_variance_ = 0.0;
  map_->start(frames_ - 1, T_cam_map_);
  const std::size_t id = map_->keyframes().back().id;
  settling_.add_keyframe(id, {previous_.index, previous_.time_s, segment_, false, 0.0});
  map_->extend(tracks, found.inliers);
  keyframe_time_ = previous_.time_s;
  speeds_.restart(previous_.time_s);
}

void Odometry::set_length(const StepTracks& tracks, const TwoView& found, const CameraFrame& frame,
                          StepResult& step) {
  const double seconds = step.time2 - step.time1;
  if (step.status == StepStatus::kNoMotion) {
    step.metric = true;  // zero metres
    return;
  }
  if (step.landmarks > 0) {
    step.length_sigma = std::hypot(step.length_sigma, scale_.uncertainty());
    step.metric = scale_.is_metric();
  } else if (step.status == StepStatus::kOk) {
    measure_pair(tracks, found, frame.camera.focal_px(), step);
  }
  if (step.metric && seconds > 0.0 && step.length > kFastestCar * seconds) step.metric = false;
  if (step.metric) {
    step.pose.t *= step.length;
  } else {
    step.length_sigma = 0.0;
    if (step.landmarks == 0)
      step.length = held_length(seconds, step.time2, step.status == StepStatus::kOk);
  }
}

void Odometry::move(const StepResult& step) {
  RelativePose motion = step.pose;
  if (motion.t.norm() > 0.0) motion.t *= step.length / motion.t.norm();
  T_cam_map_ = orthonormalised(motion * T_cam_map_);
  last_motion_ = motion;
  speeds_.add_step(step.time2, step.length);
  follow_tilt(step);
  const double seconds = step.time2 - step.time1;
  if (step.metric && seconds > 0.0) {
    last_metric_speed_ = step.length / seconds;
    last_metric_time_ = step.time2;
  }
}

void Odometry::update_map(const CameraFrame& frame, const StepTracks& tracks, StepResult& step,
                          FrameResult& result) {
  if (!map_) return;
  // A camera that only turns adds no baseline: its keyframe would triangulate noise.
  if (step.status == StepStatus::kOk &&
      map_->needs_keyframe(T_cam_map_, frame.time_s - keyframe_time_)) {
    map_->add_keyframe(frames_, T_cam_map_);
    keyframe_time_ = frame.time_s;
    static_cast<void>(map_->refine(tilt_->leveling()));
    settling_.drift(scale_.drift(map_->newest_way(), std::exchange(carried_variance_, 0.0)));
    measure_scale(tracks, frame.camera.focal_px(), step);
    T_cam_map_ = map_->keyframes().back().T_cam_map;
    result.keyframe = map_->keyframes().back().id;
    settling_.add_keyframe(*result.keyframe, {frame.index, frame.time_s, segment_, false, 0.0});
    settling_.set_metric(scale_.is_metric(), scale_.uncertainty());
  }
  const WindowKeyframe& last = map_->keyframes().back();
  settling_.add_frame(frames_, last.id, T_cam_map_ * last.T_cam_map.inverse());
  while (map_->is_over_full()) settling_.settle_oldest(*map_, pending_);
  result.settled = std::exchange(pending_, {});
}

Settled Odometry::finish() {
  if (map_) settling_.settle_all(*map_, pending_);
  lost_ = true;  // what comes is a segment of its own
  return std::exchange(pending_, {});
}

}  // namespace oneac
