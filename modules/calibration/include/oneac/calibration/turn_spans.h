#pragma once

#include "oneac/calibration/turn_measurement.h"

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace oneac {

/// A heading over time, counter-clockwise, without jumps of a full turn, in pieces between gaps.
class Heading {
 public:
  /// @param longest_gap  [s] between two readings of one piece
  explicit Heading(double longest_gap) : longest_gap_(longest_gap) {}

  /// The heading [rad] at a later time; one that is not later is not taken.
  /// @param goes_on  known since the reading before
  void add(double time_s, double angle, bool goes_on = true);
  /// Goes on by a turn [rad] since the reading before.
  void turn_by(double time_s, double turn, bool goes_on = true);
  /// [rad] how far it turned; empty where it is not known all the way.
  [[nodiscard]] std::optional<double> turn(double begin_s, double end_s) const;
  /// Readings before are not asked for any more.
  void forget_before(double time_s);

  [[nodiscard]] bool empty() const { return readings_.empty(); }
  /// [rad] of the newest reading; 0 without one
  [[nodiscard]] double last() const { return empty() ? 0.0 : readings_.back().angle; }
  /// [s] @pre not empty
  [[nodiscard]] double last_time() const { return readings_.back().time_s; }

 private:
  struct Reading {
    double time_s, angle;
    int piece;  ///< without gaps
  };
  [[nodiscard]] std::optional<std::pair<double, int>> at(double time_s) const;

  double longest_gap_;
  std::deque<Reading> readings_;
  int piece_ = 0;
};

/// The heading of a gyroscope: yaw rates by the trapezium rule.
class GyroscopeHeading {
 public:
  /// @param rate  [rad/s] counter-clockwise, not NaN
  void add(double time_s, double rate);
  [[nodiscard]] Heading& heading() { return heading_; }

 private:
  Heading heading_{0.25};  // [s] rates change within
  std::optional<std::pair<double, double>> before_;
};

/// The heading of a GPS course; not known where the vehicle is slow, since noise is its course
/// then.
class CourseHeading {
 public:
  /// @param course  [rad] clockwise from north
  /// @param speed   [m/s] over ground
  void add(double time_s, double course, double speed);
  [[nodiscard]] Heading& heading() { return heading_; }

 private:
  Heading heading_{1.5};  // [s] a receiver of 1 Hz that loses no fix
  bool goes_on_ = false;
};

/// Cuts a drive into spans between moments at which it goes straight, where a course is the
/// vehicle's heading and a stamp that is late does no harm. A span takes the turns that images and
/// sensor saw; one that either lost is left out.
class TurnSpanCutter {
 public:
  /// For a gyroscope, which comes ten times a second and more, late by half a second at most.
  [[nodiscard]] static TurnSpanCutter for_gyroscope() { return TurnSpanCutter(0.0); }
  /// For a receiver of one fix a second, which may be late by more: its course has to go straight
  /// from fix to fix, too.
  [[nodiscard]] static TurnSpanCutter for_course() { return TurnSpanCutter(1.0); }

  /// By the images, in order of time.
  /// @param turn     [rad] since the frame before, counter-clockwise
  /// @param carried  the images told it
  void add_frame(double time_s, double turn, bool carried);
  /// Spans that have become complete with what the sensor has told so far.
  /// @return how many are new
  std::size_t cut(Heading& sensor);
  [[nodiscard]] const std::vector<TurnSpan>& spans() const { return spans_; }

 private:
  /// @param sensor_around  [s] that the sensor goes straight, too, before and after a moment
  explicit TurnSpanCutter(double sensor_around) : sensor_around_(sensor_around) {}
  [[nodiscard]] bool is_straight(double time_s, const Heading& sensor) const;

  double sensor_around_;
  Heading images_{1.0};         // [s] three frames of 3 Hz
  std::deque<double> waiting_;  ///< times of frames
  std::optional<double> begin_;
  std::vector<TurnSpan> spans_;
};

}  // namespace oneac
