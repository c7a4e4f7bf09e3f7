#include "oneac/frontend/suspension_tilt.h"

#include "mainly_forward.h"
#include "wrapped_angle.h"

#include "oneac/geometry/angles.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

// [rad] pitch that braking and speeding up give a car on its springs, 1σ: 3° per g at 0.3 g.
constexpr double kSprings = 1.0 * kDegree;
// [rad] roll that bends give it, 1σ: 5° per g at 0.2 g, and how long both last [s].
constexpr double kLean = 1.0 * kDegree;
constexpr double kBend = 2.0;
// [rad] 1σ of a turn between two images, about one axis.
constexpr double kTurn = 0.03 * kDegree;
// [rad/√m] the slope of a road wanders by 1° (1.7 %) in 100 m.
constexpr double kSlopeWalk = 0.1 * kDegree;
// [σ] a measurement farther off counts as if it were so far off: a bump is no slope. What of it is
// not believed makes the tilt less certain.
constexpr double kFarthest = 3.0;
// [rad] 1σ of the pitch of a step whose direction rain or a truck has led astray: its turn is off,
// too.
constexpr double kAstray = 0.3 * kDegree;
// [s] What leads the directions that images tell astray lasts so long: headlights that move with
// the car, drops, a vehicle ahead. More images in that time see the same.
constexpr double kLasting = 0.5;

double squared(double value) {
  return value * value;
}

Eigen::Vector3d road_normal(const Tilt& tilt) {
  return levelling_rotation(tilt).row(1).transpose();
}

}  // namespace

SuspensionTilt::SuspensionTilt(const TiltBelief& mounting) {
  lose(mounting);
}

void SuspensionTilt::lose(const TiltBelief& mounting) {
  tilt_ = mounting.tilt;
  covariance_ = Eigen::Vector2d(squared(mounting.pitch_sigma) + squared(kSprings),
                                squared(mounting.roll_sigma) + squared(kLean))
                    .asDiagonal();
}

TiltBelief SuspensionTilt::tilt() const {
  return {tilt_, std::sqrt(covariance_(0, 0)), std::sqrt(covariance_(1, 1))};
}

Tilt SuspensionTilt::tilt_before(const Eigen::Matrix3d& R_now_before) const {
  return tilt_from_down(R_now_before.transpose() * road_normal(tilt_));
}

void SuspensionTilt::begin(const TiltStep::Travel& travel, const TiltBelief& mounting) {
  lose(mounting);
  const double before = tilt_.pitch_up, sigma_before = std::sqrt(covariance_(0, 0));
  measure_travel(travel, kLasting, mounting);
  // One way and a mount that contradict each other: one of them is wrong, and nothing says which
  // (Birge's ratio of two).
  const double contradiction = (tilt_.pitch_up - before) / sigma_before;
  covariance_ *= std::max(squared(contradiction), 1.0);
}

void SuspensionTilt::add_step(const TiltStep& step, const TiltBelief& mounting) {
  if (!step.R_2_1.allFinite()) return;
  turn(step);
  if (step.travel) measure_travel(*step.travel, step.seconds, mounting);
  hold(step.seconds, mounting);
}

void SuspensionTilt::turn(const TiltStep& step) {
  const Eigen::Matrix3d before = levelling_rotation(tilt_);
  tilt_ = tilt_from_down(step.R_2_1 * road_normal(tilt_));
  // An error of the normal stays where it is in the world: the levelled camera turns under it.
  const Eigen::Matrix3d yawed = levelling_rotation(tilt_) * step.R_2_1 * before.transpose();
  Eigen::Matrix2d turned;
  turned << yawed(0, 0), yawed(0, 2), yawed(2, 0), yawed(2, 2);
  covariance_ = turned * covariance_ * turned.transpose();
  covariance_.diagonal().array() += squared(kTurn) + squared(kSlopeWalk) * step.length;
}

void SuspensionTilt::measure_travel(const TiltStep::Travel& travel, double seconds,
                                    const TiltBelief& mounting) {
  const Eigen::Vector3d along = levelling_rotation(tilt_) * travel.direction;
  if (!(std::abs(along.z()) > kMainlyForward)) return;
  // A normal that is pitched up or rolled right too far has the travel rise or fall, by so much.
  const Eigen::Vector3d normal = road_normal(tilt_);
  const double alike = seconds > 0.0 ? std::max(kLasting / seconds, 1.0) : 1.0;
  const double by_images = alike * std::max(normal.dot(travel.covariance * normal), 0.0);
  const double variance = squared(travel.sigma) + by_images;
  // Springs go so far and no farther, so that is no way on wheels.
  const double springs = std::sqrt(squared(kSprings) + squared(mounting.pitch_sigma) + variance);
  const double elevation = road_normal(mounting.tilt).dot(travel.direction);
  if (std::abs(elevation) > kFarthest * springs) {
    covariance_(0, 0) += squared(kAstray);
    return;
  }
  measure({-along.z(), along.x()}, std::asin(std::clamp(along.y(), -1.0, 1.0)),
          std::sqrt(variance));
}

void SuspensionTilt::hold(double seconds, const TiltBelief& mounting) {
  if (!(seconds > 0.0)) return;
  // One independent sight of pitch and roll in 2 kBend, of angles that vary by this.
  const double rarely = std::sqrt(2.0 * kBend / seconds);
  measure({1.0, 0.0}, tilt_.pitch_up - mounting.tilt.pitch_up,
          rarely * std::hypot(mounting.pitch_sigma, kSprings));
  measure({0.0, 1.0}, wrapped_angle(tilt_.roll_right - mounting.tilt.roll_right),
          rarely * std::hypot(mounting.roll_sigma, kLean));
}

/// @param off  row · (error of the tilt) + noise
void SuspensionTilt::measure(const Eigen::Vector2d& row, double off, double sigma) {
  const double variance = row.dot(covariance_ * row) + squared(sigma);
  if (!std::isfinite(variance) || !std::isfinite(off) || !(sigma > 0.0)) return;
  const double farthest = kFarthest * std::sqrt(variance);
  const double believed = std::clamp(off, -farthest, farthest);
  const Eigen::Vector2d gain = covariance_ * row / variance;
  const Eigen::Vector2d correction = gain * believed;
  tilt_.pitch_up -= correction(0);
  tilt_.roll_right -= correction(1);
  const Eigen::Matrix2d kept = Eigen::Matrix2d::Identity() - gain * row.transpose();
  covariance_ = kept * covariance_ * kept.transpose() +
                (squared(sigma) + squared(off - believed)) * gain * gain.transpose();
}

}  // namespace oneac
