#include "tilt_step.h"

#include "oneac/geometry/angles.h"

#include <cmath>

namespace oneac {
namespace {

// [rad] 1σ of a direction of travel as images resolve it.
constexpr double kDirection = 0.2 * kDegree;
// [m/s] RMS with which a body bounces at the 1.5 Hz of its springs: 0.315 m/s², the most that
// ISO 2631 calls not uncomfortable.
constexpr double kHeave = 0.033;
// [m/s] speed of a drive whose metres are not known, in town.
constexpr double kUsualSpeed = 8.0;

/// [rad] 1σ of a way's elevation against the road.
double elevation_sigma(double speed) {
  return std::hypot(kDirection, kHeave / speed);
}

}  // namespace

TiltStep tilt_step(const StepResult& step) {
  TiltStep result;
  result.R_2_1 = step.pose.R;
  result.seconds = step.time2 - step.time1;
  if (step.status != StepStatus::kOk || !(step.pose.t.norm() > 0.0)) return result;
  const bool timed = result.seconds > 0.0;
  const double speed = step.metric && timed ? step.length / result.seconds : kUsualSpeed;
  result.length = speed * result.seconds;
  if (!(speed > 0.0)) return result;
  const double squared_length = step.pose.t.squaredNorm();
  result.travel = {step.pose.t.normalized(), elevation_sigma(speed),
                   step.covariance.bottomRightCorner<3, 3>() / squared_length};
  return result;
}

std::optional<TiltStep::Travel> travel_in_first_view(const TwoView& seen) {
  if (seen.status != StepStatus::kOk || !(seen.pose.t.norm() > 0.0)) return std::nullopt;
  const Eigen::Matrix3d R_1_2 = seen.pose.R.transpose();
  const Eigen::Matrix3d covariance =
      seen.covariance.bottomRightCorner<3, 3>() / seen.pose.t.squaredNorm();
  return TiltStep::Travel{R_1_2 * seen.pose.t.normalized(), elevation_sigma(kUsualSpeed),
                          R_1_2 * covariance * R_1_2.transpose()};
}

}  // namespace oneac
