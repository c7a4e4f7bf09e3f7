#include "gravity_estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oneac {
namespace {

constexpr std::size_t kEnough = 10;  // readings whose mean says something
constexpr double kGravity = 9.81;    // [m/s²]
// [m/s] 1σ of the difference between the speeds at two moments of a drive through a town.
constexpr double kSpeedChange = 5.0;
// [rad/s] 1σ of the yaw rate below which a drive was straight: then ω explains nothing.
constexpr double kStraight = 0.01;

}  // namespace

void GravityEstimator::add(const InertialReading& reading) {
  if (!reading.acceleration.allFinite() || !std::isfinite(reading.time_s)) return;
  if (count_++ == 0) first_s_ = last_s_ = reading.time_s;
  first_s_ = std::min(first_s_, reading.time_s);
  last_s_ = std::max(last_s_, reading.time_s);
  sum_ += reading.acceleration;
  if (!reading.yaw_rate || !std::isfinite(*reading.yaw_rate)) return;
  ++turning_count_;
  const double w = *reading.yaw_rate, y = reading.acceleration.y();
  sum_w_ += w;
  sum_ww_ += w * w;
  sum_y_ += y;
  sum_wy_ += w * y;
}

std::optional<Eigen::Vector3d> GravityEstimator::up() const {
  if (count_ < kEnough) return std::nullopt;
  Eigen::Vector3d up = sum_ / static_cast<double>(count_);
  if (turning_count_ >= kEnough) {
    const double n = static_cast<double>(turning_count_);
    const double mean_w = sum_w_ / n, mean_y = sum_y_ / n;
    const double spread = sum_ww_ / n - mean_w * mean_w;
    const bool turned = spread > kStraight * kStraight;
    const double speed = turned ? (sum_wy_ / n - mean_w * mean_y) / spread : 0.0;
    up.y() = mean_y - speed * mean_w;
  }
  if (!(up.norm() > 0.5 * kGravity)) return std::nullopt;  // no accelerometer in m/s²
  return up;
}

double GravityEstimator::sigma() const {
  const double seconds = last_s_ - first_s_;
  if (!(seconds > 0.0)) return std::numeric_limits<double>::infinity();
  return std::atan(kSpeedChange / (kGravity * seconds));
}

}  // namespace oneac
