#include "odometry.h"

#include "map/chained_pose.h"
#include "two_view/below_the_sky.h"
#include "uncertainty/step_covariance.h"

#include "oneac/base/thread_clock.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oneac {
namespace {

// [rad] 1σ of the direction of travel against that of the step before: springs and steering.
constexpr double kHeadingSigma = 0.05;

// [m] A shorter step does not tell where the car is going.
constexpr double kTellingWay = 0.1;

FrameStamp stamp_of(const CameraFrame& frame) {
  return {frame.index, frame.time_s};
}

/// The step as two views, length and map tell it.
StepResult step_result(const FrameStamp& before, const FrameStamp& now, const TwoView& seen,
                       const StepLength& length, std::size_t segment) {
  StepResult step;
  step.index1 = before.index;
  step.index2 = now.index;
  step.time1 = before.time_s;
  step.time2 = now.time_s;
  step.status = seen.status;
  step.pose = seen.pose;
  if (length.metric && seen.status != StepStatus::kNoMotion) step.pose.t *= length.length;
  step.metric = length.metric;
  step.length = length.length;
  step.length_sigma = length.sigma;
  step.camera_doubt = length.metric ? length.camera_doubt : 0.0;
  step.covariance = step_covariance(step, seen.covariance, length.sigma_m);
  step.acs = seen.pair.size();
  step.inliers = seen.inlier_count;
  step.ground_acs = length.ground_acs;
  step.landmarks = length.landmarks;
  step.segment = segment;
  return step;
}

/// The step with the covariance that is stated: neighbouring tracks share errors.
StepResult with_shared_errors(StepResult step, const TwoView& seen, const StepLength& length) {
  step.covariance = step_covariance(step, seen.covariance + seen.shared_covariance, length.sigma_m);
  return step;
}

double share_of_inliers(const TwoView& seen) {
  const auto points = static_cast<double>(seen.pair.size());
  return points > 0.0 ? static_cast<double>(seen.inlier_count) / points : 1.0;
}

StepInTime step_in_time(const FrameStamp& before, const FrameStamp& now, const TwoView& seen,
                        const RoadPair& road, const RelativePose& last_motion) {
  StepInTime step;
  step.status = seen.status;
  step.begin_s = before.time_s;
  step.end_s = now.time_s;
  step.expected = last_motion;
  step.resting = share_of_inliers(seen);
  step.car_is_known = road.car_is_known;
  step.shows_travel = road.shows_travel;
  step.through_dirt = road.through_dirt;
  return step;
}

bool is_measured(LengthSource source) {
  return source == LengthSource::kRoadImage || source == LengthSource::kStereo;
}

/// A step whose images told what cannot be: the last motion goes on.
TwoView refused(TwoView seen, const RelativePose& last_motion) {
  seen.status = StepStatus::kPredicted;
  seen.pose = last_motion;
  if (seen.pose.t.norm() > 0.0) seen.pose.t.normalize();
  seen.covariance.setZero();
  seen.shared_covariance.setZero();
  seen.set_inliers({});
  return seen;
}

/// A step of a car that stands among what moves.
TwoView resting(TwoView seen) {
  constexpr double kSame = 3.0;            // [σ]
  constexpr double kPointSigma_px = 0.25;  // of a point that does not say
  seen.status = StepStatus::kNoMotion;
  seen.pose = {};
  seen.covariance.setZero();
  seen.shared_covariance.setZero();
  std::vector<bool> inliers;
  for (const Correspondence& ac : seen.pair.correspondences) {
    const double sigma = std::max(ac.point_sigma, kPointSigma_px / seen.focal_px);
    inliers.push_back((ac.x2 - ac.x1).norm() <= kSame * sigma);
  }
  seen.set_inliers(std::move(inliers));
  return seen;
}

/// A step that looked like a rest, but was none: the road moved, or inertia does not allow it.
TwoView as_it_moved(TwoView seen, const StepLength& length, const Eigen::Vector3d& heading) {
  if (seen.status != StepStatus::kNoMotion || !(length.length > 0.0)) return seen;
  seen.status = is_measured(length.source) ? StepStatus::kOk : StepStatus::kPredicted;
  seen.pose.t = heading;
  return seen;
}

/// The motion with its length as used, whether metres or not.
RelativePose motion_of(const StepResult& step) {
  RelativePose motion = step.pose;
  if (motion.t.norm() > 0.0) motion.t *= step.length / motion.t.norm();
  return motion;
}

FrameResult frame_result(const FrameStamp& now, FrameInMap in_map, const Attitude& attitude) {
  FrameResult result;
  result.index = now.index;
  result.time_s = now.time_s;
  result.T_first_cam = in_map.T_first_cam;
  result.tilt = attitude.mounting();
  result.suspension = attitude.suspension();
  result.keyframe = in_map.keyframe;
  result.settled = std::move(in_map.settled);
  return result;
}

/// With the step that led there, the road counted where it was measured last.
FrameResult with_step(FrameResult result, StepResult step,
                      const std::optional<ScaleCorrection>& correction) {
  if (correction && correction->ground_acs > 0) step.ground_acs = correction->ground_acs;
  if (correction) result.rescaled = correction->factor;
  result.step = step;
  return result;
}

}  // namespace

Odometry::Odometry(const FrontEndOptions& options, RelativePoseInitialiser::Ptr initialiser,
                   Workers* workers)
    : workers_(workers),
      two_view_(options, std::move(initialiser)),
      attitude_(options.tilt),
      scale_(options),
      map_(options.window, workers) {}

FrameResult Odometry::start(const CameraFrame& frame) {
  newest_ = stamp_of(frame);
  attitude_.start(frame.T_vehicle_cam.linear());
  scale_.start(frame);
  setup_.start(frame);
  return frame_result(newest_, map_.start(newest_, frame.camera.focal_px()), attitude_);
}

FrameResult Odometry::advance(const CameraFrame& frame, TrackedPair pair, const RoadPair& road) {
  TwoViewPrior prior{attitude_.now().R_level_cam,   last_motion_,
                     frame.camera.focal_px(),       map_.frames(),
                     course_.now(straight_ahead()), motion_prior(frame.time_s)};
  if (scale_.is_metric() && creeps(prior.motion)) prior.depths = map_.depths(pair);
  TwoView seen = two_view_.estimate(std::move(pair), prior);
  const double estimate_ms = seen.estimate_ms, refine_ms = seen.refine_ms;
  std::string fault = std::move(seen.fault);
  double map_ms = 0.0;
  FrameResult result;
  {
    const StageTimer timer(map_ms, workers_);
    result = integrate(stamp_of(frame), std::move(seen), road);
  }
  result.step->fault = std::move(fault);
  result.step->estimate_ms = estimate_ms;
  result.step->refine_ms = refine_ms + map_ms;
  return result;
}

FrameResult Odometry::integrate(const FrameStamp& now, TwoView found, const RoadPair& road) {
  const FrameStamp before = std::exchange(newest_, now);
  auto [seen, in_time] = believed(before, now, std::move(found), road);
  const MapLink link = map_.link(seen);
  if (link.began_anew) scale_.restart(before.time_s);
  if (!in_time.direct && !in_time.repeated) {
    in_time.direct =
        scale_.measure_directly(road, seen, link.carried, attitude_.now(), heading(), in_time);
  }
  const auto begun = begin_scale(in_time, link.carried);
  // The map, which was measured by this very step, cannot confirm it.
  const auto told = begun ? std::vector<LengthMeasurement>{}
                          : scale_.measure(seen, link.carried, attitude_.now(), heading());
  const StepLength length = length_of(in_time, seen, told);
  seen = as_it_moved(std::move(seen), length, heading());
  if (seen.pose.t.norm() > 0.0) heading_ = seen.pose.t.normalized();
  if (scale_.map_is_refuted()) map_.forget();
  StepResult step = step_result(before, now, seen, length, map_.segment());
  step.repeats_image = in_time.repeated;
  if (in_time.direct && length.metric) attitude_.see_road(in_time.direct->roll_right);
  attitude_.follow(step);  // which counts for itself what lasts from step to step
  FrameResult result = moved(now, seen, with_shared_errors(step, seen, length));
  if (begun) result.rescaled *= begun->factor;
  return result;
}

Odometry::SeenInTime Odometry::believed(const FrameStamp& before, const FrameStamp& now,
                                        TwoView seen, const RoadPair& road) {
  if (repeats(seen, before, now)) {
    seen = resting(std::move(seen));
    StepInTime in_time = step_in_time(before, now, seen, road, last_motion_);
    in_time.repeated = true;
    return {std::move(seen), std::move(in_time)};
  }
  if (!turn_gate_.allows(seen.pose.R, before.time_s, now.time_s)) {
    seen = refused(std::move(seen), last_motion_);
  }
  attitude_.see(seen);
  StepInTime in_time = step_in_time(before, now, seen, road, last_motion_);
  const auto rest = scale_.rest_by_road(road, seen, attitude_.now(), heading(), in_time);
  if (rest) {
    seen = resting(std::move(seen));
    in_time.rests(seen.status, share_of_inliers(seen));
    if (rest->in_metres) in_time.direct = rest;
  } else if (!is_on_wheels(seen) || turns_back(seen, before, now)) {
    seen = refused(std::move(seen), last_motion_);
    in_time.status = seen.status;
  }
  first_rest_.follow(seen, before.time_s, now.time_s);
  in_time.began_at_rest = first_rest_.is_sure();
  return {std::move(seen), std::move(in_time)};
}

StepLength Odometry::length_of(const StepInTime& step, const TwoView& seen,
                               const std::vector<LengthMeasurement>& told) {
  setup_.follow(seen, attitude_.now().R_level_cam);
  const StepLength length = setup_.checked_after(scale_.length_of(step, told));
  if (seen.status == StepStatus::kOk && length.length > kTellingWay) {
    course_.follow(seen.pose.t.normalized(), seen.doubts_course);
  }
  return length;
}

FrameResult Odometry::moved(const FrameStamp& now, const TwoView& seen, const StepResult& step) {
  const RelativePose motion = motion_of(step);
  const auto lengths = map_.move(now, motion, seen, levelling_rotation(attitude_.mounting().tilt),
                                 scale_.lengths_hold());
  const auto correction = scale_correction(lengths, seen.focal_px);
  if (!step.repeats_image) last_motion_ = motion;
  if (correction) last_motion_.t *= correction->factor;
  T_cam_odom_ = orthonormalised(motion * T_cam_odom_);
  FrameResult result = frame_result(now, map_.settle(correction), attitude_);
  result.T_odom_cam = camera_in_frame(T_cam_odom_);
  return with_step(std::move(result), step, correction);
}

std::optional<ScaleCorrection> Odometry::begin_scale(
    const StepInTime& step, const std::optional<LengthMeasurement>& carried) {
  if (!carried || !setup_.metric_allowed()) return std::nullopt;
  const auto begun = scale_.begin(step, *carried);
  if (begun) map_.rescale(*begun);
  return begun;
}

std::optional<ScaleCorrection> Odometry::scale_correction(const std::optional<MapLengths>& lengths,
                                                          double focal_px) {
  if (!lengths) return std::nullopt;
  return setup_.checked(
      scale_.correct(*lengths, attitude_.before(lengths->newest.T_2_1.R), focal_px));
}

bool Odometry::repeats(const TwoView& seen, const FrameStamp& before, const FrameStamp& now) {
  const auto expected = scale_.expected(before.time_s, now.time_s);
  const bool may_have_stopped = expected && !(expected->least > 0.0);
  return repeated_.repeats(seen.pair, seen.focal_px, before.time_s, now.time_s) &&
         !may_have_stopped;
}

bool Odometry::is_on_wheels(const TwoView& seen) const {
  return seen.status != StepStatus::kOk || is_drivable(seen.pose.t, course_.now(straight_ahead()));
}

bool Odometry::turns_back(const TwoView& seen, const FrameStamp& before, const FrameStamp& now) {
  const bool back = seen.status == StepStatus::kOk && seen.pose.t.dot(heading_) < 0.0;
  if (!back) {
    back_since_.reset();
    came_to_rest_ = seen.status == StepStatus::kNoMotion;
    return false;
  }
  if (const auto expected = scale_.expected(before.time_s, now.time_s)) {
    return expected->least > 0.0;
  }
  // Nobody knows the speed: a car that changes its sense is seen at rest between, if it is seen
  // often enough. What lasts is true.
  constexpr double kOften_s = 0.2, kLasts_s = 1.0;
  if (came_to_rest_ || now.time_s - before.time_s > kOften_s) return false;
  if (!back_since_) back_since_ = before.time_s;
  return now.time_s - *back_since_ < kLasts_s;
}

Eigen::Vector3d Odometry::heading() const {
  if (heading_.norm() > 0.0) return heading_;
  return straight_ahead();
}

Eigen::Vector3d Odometry::straight_ahead() const {
  return -attitude_.now().R_level_cam.row(2).transpose();
}

MotionPrior Odometry::motion_prior(double end_s) const {
  MotionPrior prior;
  const double height = scale_.camera_height();
  const auto expected = scale_.expected(newest_.time_s, end_s);
  if (heading_.norm() > 0.0) {
    prior.direction = heading_;
    prior.direction_sigma = kHeadingSigma;
  }
  if (!expected || !(height > 0.0)) return prior;
  prior.length = expected->length / height;
  prior.length_sigma = expected->sigma / height;
  return prior;
}

std::optional<RelativePose> Odometry::expected() const {
  if (map_.frames() < 2) return std::nullopt;
  return last_motion_;
}

}  // namespace oneac
