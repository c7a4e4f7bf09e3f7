#include "oneac/frontend/suspension_pitch.h"

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
// [rad] pitch that braking and speeding up give a car on its springs, 1σ: 3° per g at 0.3 g.
constexpr double kSprings = 1.0 * kDegree;
// [rad/√m] the slope of a road wanders by 1° (1.7 %) in 100 m.
constexpr double kSlopeWalk = 0.1 * kDegree;
// [σ] a measurement farther off counts as if it were so far off: a bump is no slope.
constexpr double kFarthest = 3.0;

double squared(double value) {
  return value * value;
}

}  // namespace

SuspensionPitch::SuspensionPitch(const AngleBelief& mounting) {
  lose(mounting);
}

void SuspensionPitch::lose(const AngleBelief& mounting) {
  pitch_ = {mounting.angle, std::hypot(mounting.sigma, kSprings)};
}

void SuspensionPitch::add_step(const PitchStep& step) {
  pitch_.angle += step.turn.angle;
  pitch_.sigma = std::sqrt(squared(pitch_.sigma) + squared(step.turn.sigma) +
                           squared(kSlopeWalk) * step.length);
  if (!step.travel) return;
  // What the camera saw in the middle of the step, at its end.
  add_measurement({step.travel->angle + 0.5 * step.turn.angle, step.travel->sigma});
}

void SuspensionPitch::add_measurement(const AngleBelief& pitch) {
  const double total = std::hypot(pitch_.sigma, pitch.sigma);
  if (!std::isfinite(total) || !(pitch.sigma > 0.0)) return;
  const double gain = squared(pitch_.sigma / total);
  const double off = pitch.angle - pitch_.angle;
  pitch_.angle += gain * std::clamp(off, -kFarthest * total, kFarthest * total);
  pitch_.sigma *= pitch.sigma / total;
}

}  // namespace oneac
