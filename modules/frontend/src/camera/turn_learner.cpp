#include "camera/turn_learner.h"

#include "oneac/geometry/angles.h"

#include <cmath>

namespace oneac {
namespace {

constexpr double kBend = 8.0 * kDegree;  // turn that is worth a new look

/// [rad] counter-clockwise about the vertical.
double yaw_of(const Eigen::Matrix3d& R_a_b, const Tilt& tilt) {
  const Eigen::Matrix3d L = levelling_rotation(tilt);
  const Eigen::AngleAxisd turned(Eigen::Matrix3d(L * R_a_b * L.transpose()));
  return -turned.angle() * turned.axis().y();
}

bool has_bend(const TurnSpanCutter& cutter, std::size_t added) {
  const auto& spans = cutter.spans();
  for (std::size_t i = spans.size() - added; i < spans.size(); ++i) {
    if (std::abs(spans[i].by_images) > kBend) return true;
  }
  return false;
}

}  // namespace

void TurnLearner::add_frame(double time_s, bool carried, double log_focal) {
  waiting_.push_back({time_s, carried, log_focal});
}

void TurnLearner::settle_one(const SettledFrame& settled, const Tilt& tilt) {
  bool carried = true;
  for (; !waiting_.empty() && next_ < settled.frame; ++next_) {
    waiting_.pop_front();
    carried = false;
  }
  if (waiting_.empty() || settled.frame < next_) return;
  const Waiting frame = waiting_.front();
  waiting_.pop_front();
  ++next_;
  double turn = 0.0;
  if (T_first_last_) {
    const Eigen::Matrix3d R = T_first_last_->linear().transpose() * settled.T_first_cam.linear();
    // A longer focal length sees a smaller turn.
    turn = yaw_of(R, tilt) * std::exp(frame.log_focal);
  }
  carried = carried && frame.carried && T_first_last_;
  T_first_last_ = settled.T_first_cam;
  by_gyroscope_.add_frame(frame.time_s, turn, carried);
  by_course_.add_frame(frame.time_s, turn, carried);
}

bool TurnLearner::settle(const std::vector<SettledFrame>& frames, const Tilt& tilt) {
  for (const SettledFrame& frame : frames) settle_one(frame, tilt);
  const bool rate = has_bend(by_gyroscope_, by_gyroscope_.cut(gyroscope_.heading()));
  const bool course = has_bend(by_course_, by_course_.cut(course_.heading()));
  return rate || course;
}

std::vector<FocalEvidence> TurnLearner::evidence() const {
  std::vector<FocalEvidence> told;
  const auto rate = measure_focal_by_turns(by_gyroscope_.spans(), usual_gyroscope());
  if (rate) told.push_back({"gyroscope", rate->log_focal, rate->sigma});
  const auto course = measure_focal_by_turns(by_course_.spans(), usual_course());
  if (course) told.push_back({"GPS course", course->log_focal, course->sigma});
  return told;
}

}  // namespace oneac
