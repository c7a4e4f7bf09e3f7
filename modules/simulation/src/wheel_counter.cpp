#include "wheel_counter.h"

#include <Eigen/Geometry>

#include <cmath>

namespace oneac::simulation {
namespace {

constexpr double kTooth = 0.04;  // [m] 48 on a circumference of 1.9 m
constexpr double kSlip = 0.005;  // [s²/m] of driven and braked wheels: 1 % at 2 m/s²

}  // namespace

void WheelCounter::add(const PlanarState& now, double seconds) {
  const PlanarState before = started_ ? last_ : now;
  started_ = true;
  last_ = now;
  const double speed = 0.5 * (before.speed + now.speed);
  way_ += speed * seconds * size_ * (1.0 + kSlip * now.acceleration);
  const double whole = std::floor(way_ / kTooth) * kTooth;
  const double heading = 0.5 * (before.heading + now.heading);
  position_ += (whole - counted_) * Eigen::Vector2d(std::cos(heading), std::sin(heading));
  counted_ = whole;
}

Eigen::Vector2d WheelCounter::position(double heading) const {
  return Eigen::Rotation2Dd(-heading) * position_;
}

}  // namespace oneac::simulation
