#include "pitch_step.h"

#include "oneac/geometry/leveling.h"

#include <Eigen/Geometry>

#include <cmath>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
// [rad] 1σ of a turn between two images, about one axis.
constexpr double kTurn = 0.03 * kDegree;
// [rad] 1σ of a direction of travel as images resolve it.
constexpr double kDirection = 0.2 * kDegree;
// [m/s] RMS with which a body bounces at the 1.5 Hz of its springs: 0.315 m/s², the most that
// ISO 2631 calls not uncomfortable.
constexpr double kHeave = 0.033;
// [m/s] speed of a drive whose metres are not known, in town.
constexpr double kUsualSpeed = 8.0;
// cos 25°: beyond it the car manoeuvres.
constexpr double kMainlyForward = 0.9;

struct Travel {
  double elevation;  ///< [rad] of the axis above the direction of travel
  double side;       ///< share of the direction that points sideways
  bool is_forward;
};

/// Turn of the second view against the first, in the levelled first.
Eigen::Vector3d turn_of(const RelativePose& T_level) {
  const Eigen::AngleAxisd rotation(T_level.R.transpose());
  return rotation.angle() * rotation.axis();
}

/// @param direction  unit, in a levelled camera; backing says the same as driving
Travel travel_along(Eigen::Vector3d direction) {
  if (direction.z() < 0.0) direction = -direction;
  return {std::atan2(direction.y(), std::hypot(direction.x(), direction.z())),
          std::abs(direction.x()), direction.z() > kMainlyForward};
}

}  // namespace

double pitch_turn(const RelativePose& T_2_1, const Tilt& tilt) {
  return turn_of(level(T_2_1, leveling_rotation(tilt))).x();
}

PitchStep pitch_step(const StepResult& step, const TiltBelief& tilt) {
  PitchStep result;
  const RelativePose T = level(step.pose, leveling_rotation(tilt.tilt));
  const Eigen::Vector3d turn = turn_of(T);
  result.turn = {turn.x(), std::hypot(kTurn, turn.y() * tilt.roll_sigma)};
  if (step.status != StepStatus::kOk || !(T.t.norm() > 0.0)) return result;
  const double seconds = step.time2 - step.time1;
  const double speed = step.metric && seconds > 0.0 ? step.length / seconds : kUsualSpeed;
  result.length = speed * seconds;
  const Travel before = travel_along(T.R.transpose() * T.t.normalized());
  const Travel after = travel_along(T.t.normalized());
  if (!before.is_forward || !after.is_forward || !(speed > 0.0)) return result;
  const double leaning = 0.5 * (before.side + after.side) * tilt.roll_sigma;
  const double heaving = kHeave / speed;
  result.travel = {tilt.tilt.pitch_up + 0.5 * (before.elevation + after.elevation),
                   std::sqrt(kDirection * kDirection + heaving * heaving + leaning * leaning)};
  return result;
}

}  // namespace oneac
