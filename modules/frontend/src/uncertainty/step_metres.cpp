#include "oneac/frontend/step_metres.h"

#include <algorithm>
#include <cmath>

namespace oneac {

void withdraw_metres(StepResult& step) {
  const double length = step.pose.t.norm();
  if (step.metric && length > 0.0) {
    step.pose.t /= length;
    const Eigen::Matrix3d across =
        (Eigen::Matrix3d::Identity() - step.pose.t * step.pose.t.transpose()) / length;
    step.covariance.rightCols<3>() *= across;
    step.covariance.bottomRows<3>() = across * step.covariance.bottomRows<3>().eval();
  }
  step.metric = false;
  step.length_sigma = step.camera_doubt = 0.0;
}

bool is_sure(double own_sigma, double doubt, double max_uncertainty) {
  if (doubt > max_uncertainty) return false;
  return own_sigma > max_uncertainty || std::hypot(own_sigma, doubt) <= max_uncertainty;
}

void doubt_metres(StepResult& step, double doubt, double max_uncertainty) {
  const bool moves = step.metric && step.pose.t.norm() > 0.0 && step.length_sigma > 0.0;
  if (!moves || doubt == step.camera_doubt) return;
  const double before = step.length_sigma * step.length_sigma;
  const double own = std::max(before - step.camera_doubt * step.camera_doubt, 0.0);
  const double now = own + doubt * doubt;
  step.camera_doubt = doubt;
  step.length_sigma = std::sqrt(now);
  step.covariance.bottomRightCorner<3, 3>() +=
      (now - before) * step.pose.t * step.pose.t.transpose();
  if (!is_sure(std::sqrt(own), doubt, max_uncertainty)) withdraw_metres(step);
}

}  // namespace oneac
