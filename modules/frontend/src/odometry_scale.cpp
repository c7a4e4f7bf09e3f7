#include "odometry.h"

#include "oneac/robust/ground_scale.h"

#include <cmath>
#include <string>
#include <vector>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
// [-] share of the inlier bound taken as 1σ of a point's position.
constexpr double kSigmaOfThreshold = 0.5;
// A receiver's Doppler speed [m/s, 1σ]; a usual change of speed [m/s²]; a speed older than a GPS
// epoch [s] or slower than walking [m/s] measures no scale.
constexpr double kSpeedSigma = 0.1;
constexpr double kUsualAcceleration = 1.0;
constexpr double kOldestSpeed = 1.1;
constexpr double kSlowestSpeed = 1.5;
// [m] first step of a car that moves off, for want of better; the road corrects it.
constexpr double kFirstStep = 0.05;
// Samples of an accelerometer whose mean beats the log's mounting.
constexpr std::size_t kEnoughAccelerations = 10;

}  // namespace

void Odometry::measure_pair(const StepTracks& tracks, const TwoView& found, double focal_px,
                            StepResult& step) {
  if (!(camera_height_ > 0.0)) return;
  const double sigma = kSigmaOfThreshold * options_.consensus.threshold_px / focal_px;
  const auto scale = ground_scale(tracks.acs, found.inliers, step.pose, tilt_->leveling(), sigma,
                                  options_.ground_scale);
  if (!scale) return;
  step.length = scale->baseline * camera_height_;
  step.length_sigma = scale->uncertainty;
  step.ground_acs = scale->support;
  step.metric = true;
}

double Odometry::held_length(double seconds, double time, bool found_motion) const {
  if (last_motion_.t.norm() == 0.0 && last_metric_time_ == 0.0) return 1.0;  // the unit of the map
  const bool too_old = time - last_metric_time_ > options_.max_hold || !(seconds > 0.0);
  const double held = too_old ? last_motion_.t.norm() : last_metric_speed_ * seconds;
  // A map that begins with a car moving off needs some length to measure the road in.
  const bool begins = std::isinf(scale_.uncertainty()) && held < kFirstStep;
  return begins && found_motion ? kFirstStep : held;
}

void Odometry::measure_scale(double focal_px, StepResult& step) {
  if (options_.scale.source == "gps") measure_by_speed();
  if (!(camera_height_ > 0.0)) return;
  const KeyframePair pair = map_->pair_with(1);
  if (!(pair.T_2_1.t.norm() > 0.0)) return;
  const double sigma = kSigmaOfThreshold * options_.consensus.threshold_px / focal_px;
  const auto road = ground_scale(pair.acs, std::vector<bool>(pair.acs.size(), true), pair.T_2_1,
                                 tilt_->leveling(), sigma, options_.ground_scale);
  if (!road) return;
  step.ground_acs = road->support;
  const double ratio = road->baseline * camera_height_ / pair.T_2_1.t.norm();
  rescale(scale_.correct(ratio, road->uncertainty));
}

void Odometry::measure_by_speed() {
  const double length = map_->pair_with(1).T_2_1.t.norm();
  const double age = std::abs(keyframe_time_ - 0.5 * keyframe_gap_ - speed_time_);
  if (!(length > 0.0) || age > kOldestSpeed || speed_ < kSlowestSpeed) return;
  const double sigma = std::hypot(kSpeedSigma, kUsualAcceleration * age) / speed_;
  rescale(scale_.correct(speed_ * keyframe_gap_ / length, sigma));
}

void Odometry::add_acceleration(const Eigen::Vector3d& acceleration) {
  acceleration_sum_ += acceleration;
  ++accelerations_;
  if (tilt_ && options_.tilt.source == "imu") tilt_->set_given(given_tilt());
}

void Odometry::add_speed(double time_s, double speed_mps) {
  speed_ = speed_mps;
  speed_time_ = time_s;
}

Tilt Odometry::given_tilt() const {
  const std::string& source = options_.tilt.source;
  if (source == "params") {
    return {options_.tilt.pitch_up_deg * kDegree, options_.tilt.roll_right_deg * kDegree};
  }
  if (source == "drive") return {};
  const bool sampled = accelerations_ >= kEnoughAccelerations;
  if (source == "imu" && sampled) return tilt_from_gravity(R_vehicle_cam_, acceleration_sum_);
  return tilt_from_mounting(R_vehicle_cam_);
}

void Odometry::rescale(double factor) {
  if (factor == 1.0) return;
  map_->rescale(factor);
  settling_.rescale(factor);
  last_motion_.t *= factor;
}

}  // namespace oneac
