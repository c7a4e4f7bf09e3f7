#include "oneac/frontend/loop_keyframes.h"

#include "oneac/frontend/trajectory_uncertainty.h"

namespace oneac {
namespace {

/// A step as long as it is in the trajectory; one without metres may be of any length.
OdometryStep to_odometry_step(const StepResult& step) {
  OdometryStep out{step.pose, step.covariance};
  if (step.metric || !(step.length > 0.0) || !(step.pose.t.norm() > 0.0)) return out;
  const double factor = step.length / step.pose.t.norm();
  out.T_2_1.t *= factor;
  out.covariance.rightCols<3>() *= factor;
  out.covariance.bottomRows<3>() *= factor;
  out.covariance.bottomRightCorner<3, 3>() += out.T_2_1.t * out.T_2_1.t.transpose();
  return out;
}

/// Of all steps from one keyframe to the next, whose axes hardly differ.
Eigen::Vector3d shared_rotation(const Keyframe& before, const Keyframe& keyframe,
                                const StepTo& step_to) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = before.frame + 1; i <= keyframe.frame; ++i) {
    if (const std::optional<StepResult> step = step_to(i)) sum += shared_rotation_sigma(*step);
  }
  return sum;
}

}  // namespace

Eigen::Matrix<double, 6, 6> covariance_between(const Keyframe& before, const Keyframe& keyframe,
                                               const StepTo& step_to) {
  std::vector<OdometryStep> steps;
  if (before.segment != keyframe.segment) return covariance_of_steps(steps);
  for (std::size_t i = before.frame + 1; i <= keyframe.frame; ++i) {
    const std::optional<StepResult> step = step_to(i);
    if (!step || step->status == StepStatus::kPredicted) return covariance_of_steps({});
    steps.push_back(to_odometry_step(*step));
  }
  return covariance_of_steps(steps);
}

LoopKeyframe to_loop_keyframe(const Keyframe& keyframe, const Keyframe* before,
                              const StepTo& step_to, double shared_sigma) {
  LoopKeyframe out;
  out.id = keyframe.id;
  out.index = keyframe.index;
  out.time_s = keyframe.time_s;
  out.segment = keyframe.segment;
  out.T_first_cam = keyframe.T_first_cam;
  const std::optional<StepResult> step = step_to(keyframe.frame);
  // A map that has metres may have had none here: a length that is held is no measurement.
  out.metric = keyframe.metric && (!step || step->metric);
  out.scale_sigma = step && step->metric ? step->length_sigma : shared_sigma;
  if (before == nullptr) return out;
  out.covariance = covariance_between(*before, keyframe, step_to);
  out.shared_rotation = shared_rotation(*before, keyframe, step_to);
  return out;
}

void LoopKeyframes::add(const FrameResult& result) {
  if (result.step) steps_.emplace(frames_, *result.step);
  ++frames_;
  add(result.settled);
}

void LoopKeyframes::add(const Settled& settled) {
  const StepTo step_to = [&](std::size_t frame) {
    const auto found = steps_.find(frame);
    return found == steps_.end() ? std::nullopt : std::optional(found->second);
  };
  for (const Keyframe& keyframe : settled.keyframes) {
    keyframes_.push_back(
        to_loop_keyframe(keyframe, last_ ? &*last_ : nullptr, step_to, shared_sigma_));
    last_ = keyframe;
    last_->points.clear();
    steps_.erase(steps_.begin(), steps_.lower_bound(keyframe.frame));
  }
}

}  // namespace oneac
