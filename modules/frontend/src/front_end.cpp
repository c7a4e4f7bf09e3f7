#include "oneac/frontend/front_end.h"

#include "oneac/base/parameter_table.h"
#include "oneac/base/thread_clock.h"
#include "oneac/refine/two_view.h"

#include <mrpt/containers/yaml.h>

#include <cmath>
#include <utility>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
// [m] A sensor pose lower than this has its origin on the vehicle, not on the road: then the log
// does not tell the camera's height.
constexpr double kLowestMount = 0.5;
// [-] share of the inlier bound taken as 1σ of a point's position.
constexpr double kSigmaOfThreshold = 0.5;
// Plausible speeds of a car [m/s], 250 km/h; a length beyond is refused as metric.
constexpr double kFastestCar = 70.0;

Eigen::Isometry3d to_isometry(const RelativePose& pose) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = pose.R;
  T.translation() = pose.t;
  return T;
}

mrpt::containers::yaml to_yaml(ConsensusOptions options) {
  ParameterTable table;
  table.add("consensus", options);
  return mrpt::containers::yaml::FromText(table.to_yaml(false));
}

/// Rotation that is orthonormal again after many products.
Eigen::Isometry3d orthonormalised(const Eigen::Isometry3d& T) {
  Eigen::Isometry3d out = T;
  out.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return out;
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

FrontEnd::FrontEnd(const FrontEndOptions& options)
    : COutputLogger("oneac.FrontEnd"), options_(options) {
  options_.validate();
  extractor_ = make_extractor(options_.features);
  initialiser_ = make_initialiser(options_.initialiser);
  initialiser_->configure(to_yaml(options_.consensus));
}

PreparedFrame FrontEnd::prepare(CameraFrame frame) const {
  PreparedFrame prepared;
  {
    const StageTimer timer(prepared.features_ms);
    prepared.features = extractor_->prepare(frame.image.view());
  }
  prepared.frame = std::move(frame);
  prepared.frame.image = {};
  return prepared;
}

FrameResult FrontEnd::process(PreparedFrame prepared) {
  FrameResult result;
  result.index = prepared.frame.index;
  result.time_s = prepared.frame.time_s;
  if (!previous_) {
    start(prepared);
  } else {
    const StepResult step = estimate_step(prepared);
    remember(step);
    result.step = step;
  }
  result.T_first_cam = T_first_cam_;
  previous_ = std::move(prepared);
  return result;
}

Tilt FrontEnd::tilt() const {
  return tilt_ ? tilt_->tilt() : Tilt{};
}

void FrontEnd::start(const PreparedFrame& first) {
  const Eigen::Isometry3d& mount = first.frame.T_vehicle_cam;
  Tilt given{options_.tilt.pitch_up_deg * kDegree, options_.tilt.roll_right_deg * kDegree};
  if (options_.tilt.source == "log") given = tilt_from_mounting(mount.linear());
  tilt_.emplace(given, options_.tilt);
  camera_height_ = options_.camera_height;
  const double mount_height = mount.translation().z();
  if (camera_height_ == 0.0 && mount_height >= kLowestMount) camera_height_ = mount_height;
}

StepResult FrontEnd::estimate_step(const PreparedFrame& now) {
  StepResult step;
  step.index1 = previous_->frame.index;
  step.index2 = now.frame.index;
  step.time1 = previous_->frame.time_s;
  step.time2 = now.frame.time_s;
  step.features_ms = now.features_ms;
  std::vector<AffineCorrespondence> acs;
  {
    const StageTimer timer(step.features_ms);
    acs = extractor_->correspond(*previous_->features, *now.features);
    for (AffineCorrespondence& ac : acs) {
      ac = normalise(ac, previous_->frame.camera, now.frame.camera);
    }
  }
  step.acs = acs.size();
  const InitialiserInput input{acs, tilt_->leveling(), now.frame.camera.focal_px(), 0};
  InitialiserResult found;
  {
    const StageTimer timer(step.estimate_ms);
    found = initialiser_->estimate(input);
  }
  step.inliers = found.inlier_count;
  if (found.status == PoseStatus::kTooFew) {
    MRPT_LOG_DEBUG_FMT("image %zu: %zu correspondences, %zu agree: the last motion goes on",
                       now.frame.index, step.acs, step.inliers);
    step.pose = last_motion_;
    step.length = held_length(step.time2);
    if (step.pose.t.norm() > 0.0) step.pose.t.normalize();
    return step;
  }
  if (found.status == PoseStatus::kNoMotion) {
    step.status = StepStatus::kNoMotion;
    step.pose = found.pose;
    step.metric = true;  // zero metres
    return step;
  }
  step.status = StepStatus::kOk;
  {
    const StageTimer timer(step.refine_ms);
    step.pose = refined(input, found);
  }
  set_length(step, acs, found, now.frame);
  return step;
}

RelativePose FrontEnd::refined(const InitialiserInput& input, const InitialiserResult& found) {
  if (!options_.refine_enabled) return found.pose;
  const RefineResult result = refine_two_view({input.acs.begin(), input.acs.end()}, found.inliers,
                                              found.pose, input.focal_px, options_.refine);
  return result.usable() ? result.pose : found.pose;
}

void FrontEnd::set_length(StepResult& step, AcSpan acs, const InitialiserResult& found,
                          const CameraFrame& frame) {
  const double sigma =
      kSigmaOfThreshold * options_.consensus.threshold_px / frame.camera.focal_px();
  const auto scale =
      ground_scale(acs, found.inliers, step.pose, tilt_->leveling(), sigma, options_.ground_scale);
  const double seconds = step.time2 - step.time1;
  if (scale && camera_height_ > 0.0) {
    const double length = scale->baseline * camera_height_;
    step.ground_acs = scale->support;
    step.length_sigma = scale->uncertainty;
    step.metric = !(seconds > 0.0) || length <= kFastestCar * seconds;
    if (step.metric) step.length = length;
  }
  if (step.metric) {
    step.pose.t *= step.length;
  } else {
    step.length = held_length(step.time2);
  }
}

double FrontEnd::held_length(double time) const {
  const double seconds = time - previous_->frame.time_s;
  if (!(camera_height_ > 0.0)) return 1.0;  // no scale at all: steps of one unit
  if (time - last_metric_time_ > options_.max_hold || !(seconds > 0.0)) {
    return last_motion_.t.norm();
  }
  return last_metric_speed_ * seconds;
}

void FrontEnd::remember(const StepResult& step) {
  RelativePose motion = step.pose;
  if (motion.t.norm() > 0.0) motion.t *= step.length / motion.t.norm();
  T_first_cam_ = orthonormalised(T_first_cam_ * to_isometry(motion.inverse()));
  last_motion_ = motion;
  if (step.status == StepStatus::kOk) tilt_->add_step(step.pose.t);
  const double seconds = step.time2 - step.time1;
  if (step.metric && seconds > 0.0) {
    last_metric_speed_ = step.length / seconds;
    last_metric_time_ = step.time2;
  }
}

}  // namespace oneac
