#include "oneac/calibration/turn_spans.h"

#include "oneac/geometry/angles.h"

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

// The vehicle goes straight where it turns by less [rad]: the slip at an antenna a
// metre ahead of the rear axle is 0.25 degrees at 8 m/s then.
constexpr double kStraight = 2.0 * kDegree;
constexpr double kAround = 0.5;     // [s] before and after a moment
constexpr double kLeastSpan = 2.0;  // [s]
// [m/s] below, the course of a GPS is noise.
constexpr double kMoving = 3.0;

}  // namespace

void Heading::add(double time_s, double angle, bool goes_on) {
  if (!empty() && !(time_s > last_time())) return;
  if (empty() || !goes_on || time_s - last_time() > longest_gap_) ++piece_;
  readings_.push_back({time_s, angle, piece_});
}

void Heading::turn_by(double time_s, double turn, bool goes_on) {
  add(time_s, last() + turn, goes_on);
}

std::optional<double> Heading::turn(double begin_s, double end_s) const {
  const auto a = at(begin_s), b = at(end_s);
  if (!a || !b || a->second != b->second) return std::nullopt;
  return b->first - a->first;
}

/// The angle and the piece that it is of.
std::optional<std::pair<double, int>> Heading::at(double time_s) const {
  const auto next = std::upper_bound(readings_.begin(), readings_.end(), time_s,
                                     [](double t, const Reading& r) { return t < r.time_s; });
  if (next == readings_.begin() || next == readings_.end()) return std::nullopt;
  const Reading &a = *(next - 1), &b = *next;
  if (a.piece != b.piece) return std::nullopt;
  const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
  return std::pair(a.angle + (b.angle - a.angle) * share, b.piece);
}

void Heading::forget_before(double time_s) {
  while (readings_.size() > 2 && readings_[1].time_s <= time_s) readings_.pop_front();
}

void GyroscopeHeading::add(double time_s, double rate) {
  if (before_ && !(time_s > before_->first)) return;
  const double turn = before_ ? 0.5 * (before_->second + rate) * (time_s - before_->first) : 0.0;
  heading_.turn_by(time_s, turn);
  before_ = {time_s, rate};
}

void CourseHeading::add(double time_s, double course, double speed) {
  const bool moves = speed >= kMoving;
  const double last = heading_.last();
  if (moves) heading_.add(time_s, last + std::remainder(-course - last, 2.0 * M_PI), goes_on_);
  goes_on_ = moves;
}

void TurnSpanCutter::add_frame(double time_s, double turn, bool carried) {
  images_.turn_by(time_s, turn, carried);
  waiting_.push_back(time_s);
}

bool TurnSpanCutter::is_straight(double time_s, const Heading& sensor) const {
  const auto turn = images_.turn(time_s - kAround, time_s + kAround);
  if (!turn || !(std::abs(*turn) < kStraight)) return false;
  if (!(sensor_around_ > 0.0)) return true;
  const auto before = sensor.turn(time_s - sensor_around_, time_s);
  const auto after = sensor.turn(time_s, time_s + sensor_around_);
  return before && after && std::abs(*before) < kStraight && std::abs(*after) < kStraight;
}

std::size_t TurnSpanCutter::cut(Heading& sensor) {
  const std::size_t before = spans_.size();
  if (sensor.empty()) waiting_.clear();  // nothing will be known of these
  while (!waiting_.empty()) {
    const double time = waiting_.front();
    const bool complete =
        time + kAround < images_.last_time() && time + sensor_around_ < sensor.last_time();
    if (!complete) break;
    waiting_.pop_front();
    if (!is_straight(time, sensor) || (begin_ && time - *begin_ < kLeastSpan)) continue;
    if (begin_) {
      const auto seen = images_.turn(*begin_, time), told = sensor.turn(*begin_, time);
      if (seen && told) spans_.push_back({time - *begin_, *seen, *told});
    }
    begin_ = time;
    images_.forget_before(time - kAround);
    sensor.forget_before(time - sensor_around_);
  }
  return spans_.size() - before;
}

}  // namespace oneac
