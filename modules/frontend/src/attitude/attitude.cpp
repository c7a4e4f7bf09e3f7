#include "attitude.h"

#include "tilt_step.h"
#include "wrapped_angle.h"

#include "oneac/geometry/angles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oneac {
namespace {

// [rad] 1σ of a vehicle against the horizon, over the minutes of a drive.
constexpr double kLevelVehicle = 1.0 * kDegree;

/// [rad] 1σ of the elevation of a step's direction, as the images know it; 0: not known.
double elevation_sigma(const std::optional<TiltStep::Travel>& travel, const Eigen::Vector3d& down) {
  return travel ? std::sqrt(std::max(down.dot(travel->covariance * down), 0.0)) : 0.0;
}

}  // namespace

Attitude::Attitude(const TiltOptions& options)
    : options_(options), source_(source_of(options.source)) {}

Attitude::Source Attitude::source_of(const std::string& name) {
  if (name == "params") return Source::kParams;
  if (name == "imu") return Source::kImu;
  return name == "drive" ? Source::kDrive : Source::kLog;
}

void Attitude::start(const Eigen::Matrix3d& R_vehicle_cam) {
  R_vehicle_cam_ = R_vehicle_cam;
  mounting_.emplace(given(), options_, is_told());
  road_.emplace(mounting_->belief());
}

void Attitude::add_inertial(const InertialReading& reading) {
  gravity_.add(reading);
  if (mounting_ && source_ == Source::kImu) mounting_->set_given(given());
}

bool Attitude::is_told() const {
  if (source_ != Source::kLog) return true;
  constexpr double kExactly = 1e-6;  // [rad]
  const Tilt log = tilt_from_mounting(R_vehicle_cam_);
  return std::abs(log.pitch_up) > kExactly || std::abs(log.roll_right) > kExactly;
}

Tilt Attitude::given() const {
  if (source_ == Source::kParams) {
    return {options_.pitch_up_deg * kDegree, options_.roll_right_deg * kDegree};
  }
  if (source_ == Source::kDrive) return {};
  const Tilt log = tilt_from_mounting(R_vehicle_cam_);
  const auto up = gravity_.up();
  if (source_ != Source::kImu || !up) return log;
  // Weighed against the mounting on a level vehicle, which slopes and load make a degree uncertain.
  const Tilt felt = tilt_from_gravity(R_vehicle_cam_, *up);
  const double off = gravity_.sigma() / kLevelVehicle;
  const double trust = 1.0 / (1.0 + off * off);
  return {log.pitch_up + trust * (felt.pitch_up - log.pitch_up),
          log.roll_right + trust * wrapped_angle(felt.roll_right - log.roll_right)};
}

void Attitude::see(const TwoView& seen) {
  if (!mounting_ || has_seen_) return;
  const auto travel = travel_in_first_view(seen);
  if (!travel) return;
  has_seen_ = true;
  has_begun_ = true;
  // One way alone is no match for a mount that somebody stated.
  TiltEstimator first = *mounting_;  // the step itself comes with follow()
  if (!is_told()) first.add_step(seen.pose);
  road_->begin(*travel, first.belief());
}

void Attitude::see_road(const AngleBelief& roll_right) {
  if (mounting_) mounting_->see_road(roll_right);
}

void Attitude::follow(const StepResult& step) {
  if (!mounting_) return;
  const bool known = std::exchange(has_begun_, false);
  if (step.status == StepStatus::kPredicted) {
    road_->lose(mounting_->belief());
    return;
  }
  TiltStep moved = tilt_step(step);
  const std::optional<TiltStep::Travel> travel = moved.travel;
  if (known) moved.travel.reset();
  road_->add_step(moved, mounting_->belief());
  if (step.status == StepStatus::kOk) {
    mounting_->add_step(step.pose, elevation_sigma(travel, now().R_level_cam.row(1).transpose()));
  }
}

TiltBelief Attitude::mounting() const {
  return mounting_ ? mounting_->belief() : TiltBelief{};
}

AngleBelief Attitude::suspension() const {
  if (!road_) return {};
  const TiltBelief against_road = road_->tilt();
  return {against_road.tilt.pitch_up - mounting().tilt.pitch_up, against_road.pitch_sigma};
}

Levelling Attitude::now() const {
  return road_ ? levelling(road_->tilt().tilt.pitch_up) : Levelling{};
}

Levelling Attitude::before(const Eigen::Matrix3d& R_now_before) const {
  return road_ ? levelling(road_->tilt_before(R_now_before).pitch_up) : Levelling{};
}

Levelling Attitude::levelling(double pitch_up) const {
  const TiltBelief camera = mounting();
  return {levelling_rotation({pitch_up, camera.tilt.roll_right}), road_->tilt().pitch_sigma,
          camera.roll_sigma};
}

}  // namespace oneac
