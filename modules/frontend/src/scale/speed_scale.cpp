#include "speed_scale.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace oneac {
namespace {

constexpr double kUsualAcceleration = 1.0;  // [m/s²] of a car in traffic
constexpr double kLatency = 0.2;            // [s] 1σ: receivers filter, and stamp late
constexpr double kSlowest = 1.5;            // [m/s] walking: 0.1 m/s is too much of it
constexpr double kLongestGap = 2.5;         // [s] between fixes: one epoch of 1 Hz may be missing
constexpr double kOldestSpeed = 1.1;        // [s] a speed says nothing about a moment farther away
constexpr double kRemembered = 10.0;        // [s] of the way
constexpr double kGuessOver = 0.5;          // [s] of the way around a first guess, at most

}  // namespace

void SpeedScale::add_speed(const SpeedReading& told) {
  if (!std::isfinite(told.time_s) || !std::isfinite(told.speed) || told.speed < 0.0) return;
  if (!speeds_.empty() && !(told.time_s > speeds_.back().time_s)) return;
  speeds_.push_back(told);
  while (told.time_s - speeds_.front().time_s > kRemembered) speeds_.pop_front();
}

void SpeedScale::add_step(double time_s, double length) {
  way_.push_back({time_s, (way_.empty() ? 0.0 : way_.back().value) + length});
  while (way_.back().time_s - way_.front().time_s > kRemembered) way_.pop_front();
}

void SpeedScale::restart(double time_s) {
  way_.clear();
  way_.push_back({time_s, 0.0});
}

void SpeedScale::rescale(double factor) {
  for (Sample& sample : way_) sample.value *= factor;
}

double SpeedScale::length_at(double time_s) const {
  const auto after = std::lower_bound(way_.begin(), way_.end(), time_s,
                                      [](const Sample& s, double t) { return s.time_s < t; });
  if (after == way_.begin()) return way_.front().value;
  if (after == way_.end()) return way_.back().value;
  const auto before = std::prev(after);
  const double share = (time_s - before->time_s) / (after->time_s - before->time_s);
  return before->value + share * (after->value - before->value);
}

std::optional<ScaleMeasurement> SpeedScale::measure() {
  double truth = 0.0, map = 0.0, variance = 0.0;
  while (speeds_.size() >= 2 && !way_.empty() && speeds_[1].time_s <= way_.back().time_s) {
    const SpeedReading a = speeds_[0], b = speeds_[1];
    speeds_.pop_front();
    const double seconds = b.time_s - a.time_s;
    const double speed = 0.5 * (a.speed + b.speed);
    if (a.time_s < way_.front().time_s || seconds > kLongestGap || speed < kSlowest) continue;
    truth += speed * seconds;
    map += length_at(b.time_s) - length_at(a.time_s);
    // A receiver's errors last for seconds.
    const double from_speed = std::max(a.sigma, b.sigma) * seconds;
    const double from_bend = kUsualAcceleration * seconds * seconds / 8.0;
    const double from_latency = kLatency * std::abs(b.speed - a.speed);
    variance += from_speed * from_speed + from_bend * from_bend + from_latency * from_latency;
  }
  if (!(truth > 0.0) || !(map > 0.0)) return std::nullopt;
  return ScaleMeasurement{truth / map, std::sqrt(variance) / truth, LengthSource::kSpeed};
}

std::optional<SpeedScale::Speed> SpeedScale::speed_at(double time_s) const {
  const auto after = std::lower_bound(speeds_.begin(), speeds_.end(), time_s,
                                      [](const SpeedReading& s, double t) { return s.time_s < t; });
  const SpeedReading* next = after == speeds_.end() ? nullptr : &*after;
  const SpeedReading* last = after == speeds_.begin() ? nullptr : &*std::prev(after);
  if (next != nullptr && last != nullptr && next->time_s - last->time_s <= kLongestGap) {
    const double share = (time_s - last->time_s) / (next->time_s - last->time_s);
    const double change = next->speed - last->speed;
    const double sigma = std::max(last->sigma, next->sigma);
    return Speed{last->speed + share * change, std::hypot(sigma, kLatency * change)};
  }
  const bool last_is_nearer =
      next == nullptr || (last != nullptr && time_s - last->time_s < next->time_s - time_s);
  const SpeedReading* nearest = last_is_nearer ? last : next;
  if (nearest == nullptr) return std::nullopt;
  const double age = std::abs(time_s - nearest->time_s);
  if (age > kOldestSpeed) return std::nullopt;
  return Speed{nearest->speed, std::hypot(nearest->sigma, kUsualAcceleration * age)};
}

std::optional<ScaleMeasurement> SpeedScale::first_guess() const {
  if (way_.size() < 2) return std::nullopt;
  const double end = way_.back().time_s;
  const double begin = std::max(way_.front().time_s, end - kGuessOver);
  const double map = length_at(end) - length_at(begin);
  const auto speed = speed_at(0.5 * (begin + end));
  if (!(map > 0.0) || !speed || speed->value < kSlowest) return std::nullopt;
  return ScaleMeasurement{speed->value * (end - begin) / map, speed->sigma / speed->value,
                          LengthSource::kSpeed};
}

}  // namespace oneac
