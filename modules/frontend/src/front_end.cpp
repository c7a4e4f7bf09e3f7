#include "oneac/frontend/front_end.h"

#include "camera/camera_learner.h"
#include "odometry.h"
#include "scale/stereo_depths.h"
#include "two_view/normalised_pair.h"

#include "oneac/base/require.h"
#include "oneac/base/thread_clock.h"
#include "oneac/base/workers.h"
#include "oneac/initialisers/checked_answer.h"

#include <mrpt/containers/yaml.h>
#include <mrpt/obs/CObservation.h>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace oneac {
namespace {

mrpt::containers::yaml initialiser_yaml(const FrontEndOptions& options) {
  const InitialiserOptions chosen{options.estimator, options.consensus, options.gc_ransac};
  return mrpt::containers::yaml::FromText(chosen.to_yaml());
}

IntakeOptions intake_options(const FrontEndOptions& options) {
  const bool stereo = options.scale.source == "stereo";
  return {options.camera,
          {options.mount_convention, options.calibration, stereo, std::nullopt,
           options.undistorted_fov_deg}};
}

/// The comparison is false for NaN.
void require_within(double value, double limit, const char* field) {
  std::ostringstream bound;
  bound << "from " << -limit << " to " << limit;
  require(std::abs(value) <= limit, field, value, bound.str());
}

}  // namespace

const char* to_string(StepStatus status) {
  switch (status) {
    case StepStatus::kOk:
      return "ok";
    case StepStatus::kNoMotion:
      return "no_motion";
    case StepStatus::kPredicted:
      return "predicted";
  }
  return "unknown";
}

FrontEnd::FrontEnd(const FrontEndOptions& options, int threads)
    : COutputLogger("oneac.FrontEnd"),
      options_(options),
      stereo_(options.scale.source == "stereo"),
      wheels_(options.scale.source == "wheels"),
      workers_(std::make_shared<Workers>(threads)),
      intake_(intake_options(options)),
      profiler_(true) {
  options_.validate();
  tracker_ = make_tracker(options_.features, workers_);
  const RelativePoseInitialiser::Ptr initialiser = make_initialiser(options_.initialiser);
  configure_checked(*initialiser, initialiser_yaml(options_));
  odometry_ = std::make_unique<Odometry>(options_, initialiser, workers_.get());
  learner_ = std::make_unique<CameraLearner>(options_.self_calibration);
}

FrontEnd::~FrontEnd() {
  profiler_.clear(true);  // what is left in it would be printed
}

PreparedFrame FrontEnd::prepare(CameraFrame frame) const {
  PreparedFrame prepared;
  {
    const StageTimer timer(prepared.features_ms);
    prepared.features = tracker_->prepare(frame.image.view(), frame.mask.view());
  }
  prepared.frame = std::move(frame);
  return prepared;
}

FrameResult FrontEnd::process(PreparedFrame prepared) {
  if (!started_) learner_->start(prepared.frame.camera, prepared.frame.raw_camera);
  prepared.frame.camera = learner_->used();
  const CameraFrame& frame = prepared.frame;
  double features_ms = prepared.features_ms;
  TrackedPair pair;
  RoadPair road;
  {
    const StageTimer timer(features_ms, workers_.get());
    road = {previous_road_, road_image(prepared.features, frame.image.view()), frame.camera, {}};
    correspondences_ = tracker_->advance(std::move(prepared.features), hint());
    road.workers = workers_.get();
    road.mask = tracker_->unused();
    road.car_is_known = tracker_->knows_car();
    road.shows_travel = tracker_->shows_travel();
    road.through_dirt = tracker_->views_through_dirt();
    if (stereo_) correspondences_ = with_stereo_depths(std::move(correspondences_), frame);
    pair = normalised(correspondences_, previous_camera_, frame);
    if (const auto lens = learner_->lens()) pair = lens->corrected(std::move(pair));
  }
  previous_camera_ = frame.camera;
  previous_road_ = road.second;
  prepared.frame.image = {};
  prepared.frame.mask = {};
  prepared.frame.right = {};
  prepared.frame.right_mask = {};
  if (!started_) {
    started_ = true;
    FrameResult first = odometry_->start(frame);
    learner_->add_frame(first.time_s, false);
    if (keeps_trajectory_) trajectory_.add(first);
    return first;
  }
  FrameResult result = odometry_->advance(frame, std::move(pair), road);
  {
    const StageTimer timer(result.step->refine_ms);
    learn_camera(result);
  }
  result.step->features_ms = features_ms;
  constexpr double kMillisecond = 1e-3;
  profiler_.registerUserMeasure("features", features_ms * kMillisecond, true);
  profiler_.registerUserMeasure("estimate", result.step->estimate_ms * kMillisecond, true);
  profiler_.registerUserMeasure("refine", result.step->refine_ms * kMillisecond, true);
  if (result.step->status == StepStatus::kPredicted) {
    MRPT_LOG_DEBUG_FMT("image %zu: %zu correspondences, %zu agree: the last motion goes on",
                       frame.index, result.step->acs, result.step->inliers);
  }
  if (keeps_trajectory_) trajectory_.add(result);
  return result;
}

void FrontEnd::learn_camera(const FrameResult& result) {
  const PinholeCamera before = learner_->belief().raw_used;
  learner_->add_frame(result.time_s, result.step->status != StepStatus::kPredicted);
  bool changed = learner_->follow_turns(result.settled.frames, tilt());
  if (const auto keyframe = odometry_->newest_keyframe()) {
    changed = learner_->follow(*keyframe, result.index, result.time_s) || changed;
  }
  odometry_->blame_camera(learner_->fault());
  odometry_->doubt_camera(learner_->belief().doubt);
  if (!changed) return;
  previous_camera_ = learner_->used();
  odometry_->renormalise({before, learner_->belief().raw_used});
}

const CameraBelief& FrontEnd::camera_belief() const {
  return learner_->belief();
}

MotionHint FrontEnd::hint() const {
  MotionHint hint;
  hint.camera = previous_camera_;
  hint.R_level_cam = levelling_rotation(tilt());
  hint.T_2_1 = odometry_->expected();
  if (!hint.T_2_1) return hint;
  hint.scaled = odometry_->scale().is_metric() && camera_height() > 0.0;
  if (hint.scaled) hint.T_2_1->t /= camera_height();
  return hint;
}

std::optional<FrameResult> FrontEnd::feed(const mrpt::obs::CObservation::Ptr& observation,
                                          const ImageMasks& masks) {
  if (!observation) throw std::invalid_argument("FrontEnd::feed: observation = null");
  Intake intake = intake_.take(*observation, masks);
  if (intake.passed_over) log_first(*intake.passed_over);
  if (intake.inertial) {
    const auto& rate = intake.inertial->angular_rate;
    if (rate) add_yaw_rate(intake.inertial->time_s, rate->z());
    if (const auto& acceleration = intake.inertial->acceleration) {
      add_acceleration(intake.inertial->time_s, *acceleration,
                       rate ? std::optional(rate->z()) : std::nullopt);
    }
  }
  if (const auto& told = intake.course) add_course(told->time_s, told->course, told->speed);
  if (const auto& told = wheels_ ? intake.wheels : intake.speed) {
    add_speed(told->time_s, told->speed, told->sigma);
  }
  if (!intake.frame) return std::nullopt;
  if (!started_ && !intake_.scaling_note().empty()) {
    MRPT_LOG_WARN_STREAM(intake_.scaling_note());
  }
  return process(prepare(std::move(*intake.frame)));
}

// Other sensors and readings are no fault; images and readings that are lost may be one.
void FrontEnd::log_first(PassedOver reason) const {
  if (intake_.counts().of(reason) != 1) return;
  const bool harmless = reason == PassedOver::kOtherClass || reason == PassedOver::kOtherSensor ||
                        reason == PassedOver::kNotNeeded;
  logFmt(harmless ? mrpt::system::LVL_DEBUG : mrpt::system::LVL_WARN,
         "an observation is passed over: %s", to_string(reason));
}

void FrontEnd::add_acceleration(double time_s, const Eigen::Vector3d& acceleration,
                                std::optional<double> yaw_rate) {
  require_within(time_s, SensorLimits::kLatest, "add_acceleration: time_s");
  for (const double axis : acceleration) {
    require_within(axis, SensorLimits::kAcceleration, "add_acceleration: acceleration");
  }
  if (yaw_rate) require_within(*yaw_rate, SensorLimits::kRate, "add_acceleration: yaw_rate");
  odometry_->add_inertial({time_s, acceleration, yaw_rate});
}

void FrontEnd::add_yaw_rate(double time_s, double yaw_rate) {
  require_within(time_s, SensorLimits::kLatest, "add_yaw_rate: time_s");
  require_within(yaw_rate, SensorLimits::kRate, "add_yaw_rate: yaw_rate");
  learner_->add_yaw_rate(time_s, yaw_rate);
}

void FrontEnd::add_course(double time_s, double course, double speed_mps) {
  constexpr double kTurn = 4.0 * M_PI;
  require_within(time_s, SensorLimits::kLatest, "add_course: time_s");
  require_within(course, kTurn, "add_course: course");
  require(speed_mps >= 0.0 && speed_mps <= SensorLimits::kFastest, "add_course: speed_mps",
          speed_mps, "from 0 to 1000");
  learner_->add_course(time_s, course, speed_mps);
}

void FrontEnd::add_speed(double time_s, double speed_mps, double sigma_mps) {
  require_within(time_s, SensorLimits::kLatest, "add_speed: time_s");
  require(speed_mps >= 0.0 && speed_mps <= SensorLimits::kFastest, "add_speed: speed_mps",
          speed_mps, "from 0 to 1000");
  require(sigma_mps > 0.0 && sigma_mps <= SensorLimits::kFastest, "add_speed: sigma_mps", sigma_mps,
          "above 0, up to 1000");
  odometry_->add_speed({time_s, speed_mps, sigma_mps});
}

TiltBelief FrontEnd::tilt_belief() const {
  return odometry_->attitude().mounting();
}

SettledTracks FrontEnd::take_tracks() {
  return odometry_->take_tracks();
}

Settled FrontEnd::finish() {
  learner_->finish();
  if (started_) odometry_->blame_camera(learner_->fault());
  odometry_->doubt_camera(learner_->belief().doubt);
  Settled settled = odometry_->finish();
  trajectory_.finish(settled);
  return settled;
}

Tilt FrontEnd::tilt() const {
  return tilt_belief().tilt;
}

std::optional<NewestKeyframe> FrontEnd::newest_keyframe() const {
  return odometry_->newest_keyframe();
}

GreyImage FrontEnd::car_mask() const {
  return tracker_->car_mask();
}

bool FrontEnd::car_mask_refused() const {
  return tracker_->car_mask_refused();
}

double FrontEnd::camera_height() const {
  return odometry_->scale().camera_height();
}

const std::vector<std::string>& FrontEnd::setup_faults() const {
  return odometry_->setup().faults();
}

double FrontEnd::length_doubt() const {
  return odometry_->scale().camera_doubt();
}

bool FrontEnd::stamps_are_wrong() const {
  return odometry_->scale().stamps_are_wrong();
}

double FrontEnd::scale_uncertainty() const {
  return odometry_->scale().uncertainty();
}

}  // namespace oneac
