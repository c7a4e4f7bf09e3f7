#include "odometry.h"
#include "pitch_step.h"

#include <cmath>
#include <string>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
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

AngleBelief Odometry::mounting_pitch() const {
  const TiltBelief& belief = tilt_->belief();
  return {belief.tilt.pitch_up, belief.pitch_sigma};
}

void Odometry::follow_tilt(const StepResult& step) {
  if (step.status == StepStatus::kPredicted) {
    pitch_->lose(mounting_pitch());
    return;
  }
  pitch_->add_step(pitch_step(step, tilt_->belief()));
  if (step.status == StepStatus::kOk) tilt_->add_step(step.pose);
}

void Odometry::tell_tilt(FrameResult& result) const {
  result.tilt = tilt_->belief();
  const AngleBelief& pitch = pitch_->pitch();
  result.suspension = {pitch.angle - result.tilt.tilt.pitch_up, pitch.sigma};
}

Eigen::Matrix3d Odometry::leveling() const {
  return leveling_rotation({pitch_->pitch().angle, tilt_->tilt().roll_right});
}

Eigen::Matrix3d Odometry::leveling_before(const RelativePose& T_now_before) const {
  const double turn = pitch_turn(T_now_before, tilt_->tilt());
  return leveling_rotation({pitch_->pitch().angle - turn, tilt_->tilt().roll_right});
}

GroundScaleOptions Odometry::ground_scale_options() const {
  GroundScaleOptions options = options_.ground_scale;
  options.plane_tilt_deg = std::hypot(options.plane_tilt_deg, pitch_->pitch().sigma / kDegree);
  options.cross_fall_deg = std::hypot(options.cross_fall_deg, tilt_->belief().roll_sigma / kDegree);
  return options;
}

}  // namespace oneac
