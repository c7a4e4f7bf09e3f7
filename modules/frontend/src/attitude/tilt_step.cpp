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
  result.travel = {step.pose.t.normalized(), std::hypot(kDirection, kHeave / speed),
                   step.covariance.bottomRightCorner<3, 3>() / squared_length};
  return result;
}

}  // namespace oneac
