#pragma once

#include "oneac/calibration/focal_evidence.h"
#include "oneac/calibration/turn_spans.h"
#include "oneac/frontend/keyframe.h"
#include "oneac/geometry/levelling.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

namespace oneac {

/// Turns of the settled drive against those of a gyroscope and a GPS course.
class TurnLearner {
 public:
  /// [rad/s] counter-clockwise, in order of time
  void add_yaw_rate(double time_s, double rate) { gyroscope_.add(time_s, rate); }
  /// [rad] clockwise from north, [m/s]; in order of time
  void add_course(double time_s, double course, double speed) {
    course_.add(time_s, course, speed);
  }
  /// The next frame of the drive.
  /// @param carried    the images told its step
  /// @param log_focal  ln(focal length in use / given one)
  void add_frame(double time_s, bool carried, double log_focal);
  /// Frames that have become final.
  /// @return whether a bend is new that a sensor saw, too
  bool settle(const std::vector<SettledFrame>& frames, const Tilt& tilt);
  /// What both say of ln(f / given f), as far as they tell.
  [[nodiscard]] std::vector<FocalEvidence> evidence() const;

 private:
  struct Waiting {
    double time_s;
    bool carried;
    double log_focal;
  };
  void settle_one(const SettledFrame& frame, const Tilt& tilt);

  GyroscopeHeading gyroscope_;
  CourseHeading course_;
  TurnSpanCutter by_gyroscope_ = TurnSpanCutter::for_gyroscope();
  TurnSpanCutter by_course_ = TurnSpanCutter::for_course();
  std::deque<Waiting> waiting_;
  std::size_t next_ = 0;  ///< frame that waits first
  std::optional<Eigen::Isometry3d> T_first_last_;
};

}  // namespace oneac
