#include "inertia.h"

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

constexpr double kGate = 3.0;  // [σ] of measurements and of the speed itself
// [m/s] speeds are never surer than this: engines and brakes jerk within a step.
constexpr double kSurest = 0.05;

}  // namespace

bool ExpectedLength::allows(double length_m, double sigma_m) const {
  return length_m >= least - kGate * sigma_m && length_m <= most + kGate * sigma_m;
}

Inertia::Inertia(const ScaleOptions& options, double memory_s)
    : acceleration_(options.acceleration),
      max_acceleration_(options.max_acceleration),
      memory_s_(memory_s) {}

std::optional<ExpectedLength> Inertia::expect(double begin_s, double end_s) const {
  const double seconds = end_s - begin_s;
  const double age = 0.5 * (begin_s + end_s) - time_s_;
  if (!known_ || !(seconds > 0.0) || age > memory_s_) return std::nullopt;
  const double reach = max_acceleration_ * std::abs(age) + kGate * sigma_;
  ExpectedLength expected;
  expected.length = speed_ * seconds;
  expected.sigma = std::hypot(sigma_, acceleration_ * age) * seconds;
  expected.least = std::max(0.0, speed_ - reach) * seconds;
  expected.most = (speed_ + reach) * seconds;
  return expected;
}

void Inertia::tell(double begin_s, double end_s, double length, double sigma) {
  const double seconds = end_s - begin_s;
  if (!(seconds > 0.0) || !std::isfinite(length) || !std::isfinite(sigma)) return;
  const double measured = length / seconds;
  const double noise = std::max(sigma / seconds, kSurest);
  if (const auto before = expect(begin_s, end_s)) {
    const double prior = before->sigma / seconds;
    const double gain = prior * prior / (prior * prior + noise * noise);
    speed_ += gain * (measured - speed_);
    sigma_ = std::sqrt(gain) * noise;
  } else {
    speed_ = measured;
    sigma_ = noise;
  }
  known_ = true;
  time_s_ = 0.5 * (begin_s + end_s);
}

}  // namespace oneac
