#include "odometry.h"
#include "tilt_step.h"

#include "oneac/geometry/angles.h"

#include <cmath>
#include <string>

namespace oneac {
namespace {

// [rad] 1σ of a vehicle against the horizon, over the minutes of a drive.
constexpr double kLevelVehicle = 1.0 * kDegree;

}  // namespace

void Odometry::add_inertial(const InertialReading& reading) {
  gravity_.add(reading);
  if (tilt_ && options_.tilt.source == "imu") tilt_->set_given(given_tilt());
}

Tilt Odometry::given_tilt() const {
  const std::string& source = options_.tilt.source;
  if (source == "params") {
    return {options_.tilt.pitch_up_deg * kDegree, options_.tilt.roll_right_deg * kDegree};
  }
  if (source == "drive") return {};
  const Tilt log = tilt_from_mounting(R_vehicle_cam_);
  const auto up = gravity_.up();
  if (source != "imu" || !up) return log;
  // Weighed against the mounting on a level vehicle, which slopes and load make a degree uncertain.
  const Tilt felt = tilt_from_gravity(R_vehicle_cam_, *up);
  const double off = gravity_.sigma() / kLevelVehicle;
  const double trust = 1.0 / (1.0 + off * off);
  return {log.pitch_up + trust * (felt.pitch_up - log.pitch_up),
          log.roll_right + trust * (felt.roll_right - log.roll_right)};
}

void Odometry::follow_tilt(const StepResult& step) {
  if (step.status == StepStatus::kPredicted) {
    road_tilt_->lose(tilt_->belief());
    return;
  }
  road_tilt_->add_step(tilt_step(step), tilt_->belief());
  if (step.status == StepStatus::kOk) tilt_->add_step(step.pose);
}

void Odometry::tell_tilt(FrameResult& result) const {
  result.tilt = tilt_->belief();
  const TiltBelief against_road = road_tilt_->tilt();
  result.suspension = {against_road.tilt.pitch_up - result.tilt.tilt.pitch_up,
                       against_road.pitch_sigma};
}

Eigen::Matrix3d Odometry::leveling() const {
  return leveling_rotation({road_tilt_->tilt().tilt.pitch_up, tilt_->tilt().roll_right});
}

Eigen::Matrix3d Odometry::leveling_before(const RelativePose& T_now_before) const {
  const Tilt before = road_tilt_->tilt_before(T_now_before.R);
  return leveling_rotation({before.pitch_up, tilt_->tilt().roll_right});
}

GroundScaleOptions Odometry::ground_scale_options() const {
  GroundScaleOptions options = options_.ground_scale;
  const double pitch_sigma = road_tilt_->tilt().pitch_sigma;
  options.plane_tilt_deg = std::hypot(options.plane_tilt_deg, pitch_sigma / kDegree);
  options.cross_fall_deg = std::hypot(options.cross_fall_deg, tilt_->belief().roll_sigma / kDegree);
  return options;
}

}  // namespace oneac
