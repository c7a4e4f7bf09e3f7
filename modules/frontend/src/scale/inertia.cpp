#include "inertia.h"

#include "oneac/base/median.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace oneac {
namespace {

constexpr double kGate = 3.0;  // [σ] of measurements and of the speed itself
// [m/s] speeds are never surer than this: engines and brakes jerk within a step.
constexpr double kSurest = 0.05;
constexpr double kClear = 0.25;         // [intervals] nearer to a whole number it is no other one
constexpr std::size_t kIntervals = 25;  // of which the median is taken

}  // namespace

bool ExpectedLength::allows(double length_m, double sigma_m) const {
  return length_m >= least - kGate * sigma_m && length_m <= most + kGate * sigma_m;
}

void ShutterClock::tell(double seconds) {
  if (!(seconds > 0.0)) return;
  newest_.push_back(seconds);
  if (newest_.size() > kIntervals) newest_.pop_front();
  interval_ = upper_median(std::vector<double>(newest_.begin(), newest_.end()));
}

StepTime ShutterClock::between(double seconds) const {
  if (!(interval_ > 0.0)) return {seconds, 0.0};
  // Between two whole numbers either may be true.
  const double whole = seconds / interval_;
  const double fewer = interval_ * std::max(1.0, std::floor(whole + kClear));
  const double more = interval_ * std::max(1.0, std::ceil(whole - kClear));
  const double least = std::min(seconds, fewer), most = std::max(seconds, more);
  return {0.5 * (most + least), 0.5 * (most - least)};
}

Inertia::Inertia(const ScaleOptions& options, double memory_s)
    : acceleration_(options.acceleration),
      max_acceleration_(options.max_acceleration),
      shared_(options.road_uncertainty),
      memory_s_(memory_s) {}

std::optional<ExpectedLength> Inertia::expect(double begin_s, double end_s) const {
  const double seconds = end_s - begin_s;
  const double age = 0.5 * (begin_s + end_s) - time_s_;
  if (!known_ || !(seconds > 0.0) || age > memory_s_) return std::nullopt;
  const double reach = max_acceleration_ * std::abs(age) + kGate * sigma_;
  ExpectedLength expected;
  const StepTime time = clock_.between(seconds);
  expected.length = speed_ * time.mean;
  expected.sigma =
      std::hypot(std::hypot(sigma_, acceleration_ * age) * time.mean, speed_ * time.half_range);
  expected.common = common_ * expected.length;
  expected.least = std::max(0.0, speed_ - reach) * time.least();
  expected.most = (speed_ + reach) * time.most();
  return expected;
}

void Inertia::tell(double begin_s, double end_s, double length, double sigma, double common) {
  const double middle = 0.5 * (begin_s + end_s);
  const double seconds = end_s - begin_s;
  if (!(seconds > 0.0) || !std::isfinite(length) || !std::isfinite(sigma)) return;
  const StepTime time = clock_.between(seconds);
  const double measured = length / time.mean;
  const double noise = std::max(std::hypot(sigma, measured * time.half_range) / time.mean, kSurest);
  if (expect(begin_s, end_s)) {
    const double prior = std::hypot(sigma_, acceleration_ * (middle - time_s_));
    const double gain = prior * prior / (prior * prior + noise * noise);
    speed_ += gain * (measured - speed_);
    // Steps in a row share the errors of the road's height, which do not average out.
    sigma_ = std::max(std::sqrt(gain) * noise, shared_ * speed_);
  } else {
    speed_ = measured;
    sigma_ = noise;
  }
  known_ = true;
  time_s_ = middle;
  common_ = common;
}

}  // namespace oneac
