#include "crossing_traffic.h"

#include <algorithm>
#include <limits>

namespace oneac::simulation {
namespace {

constexpr double kPlace = 0.8;      // of the street's length
constexpr double kAhead_m = 16.0;   // of the car when it passes
constexpr double kSpeed_mps = 6.0;  // brisk for a crossing
constexpr double kStart_m = 22.0;   // from the lane: hidden behind the facades
constexpr double kLength_m = 4.2;   // of the vehicle
constexpr double kWidth_m = 1.9;
constexpr double kHeight_m = 1.7;
constexpr double kTimeStep_s = 0.05;  // how finely the moment is looked for

/// When the car comes nearest to a point.
double time_at(const Route& route, const Eigen::Vector2d& point, double duration_s) {
  double best = 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  double t = 0.0;
  while (t <= duration_s) {
    const double distance = (route.at(t).position - point).squaredNorm();
    if (distance < nearest) {
      nearest = distance;
      best = t;
    }
    t += kTimeStep_s;
  }
  return best;
}

}  // namespace

Box CrossingVehicle::at(double time_s) const {
  const Eigen::Vector3d shift = std::clamp(time_s - start_s, 0.0, duration_s) * velocity;
  Box box = at_start;
  box.low += shift;
  box.high += shift;
  return box;
}

std::vector<CrossingVehicle> crossing_traffic(const Route& route, double duration_s) {
  std::vector<CrossingVehicle> vehicles;
  double side = 1.0;
  for (const Leg& leg : route.legs()) {
    const double x = kPlace * leg.length_m;
    const Eigen::Vector2d from = leg.to_world({x, side * kStart_m});
    const Eigen::Vector2d across = leg.to_world({x, -side * kStart_m}) - from;
    const Eigen::Vector2d corner = leg.to_world({x + kWidth_m, side * (kStart_m + kLength_m)});
    CrossingVehicle vehicle;
    vehicle.at_start.kind = Box::Kind::kVehicle;
    vehicle.at_start.low << from.cwiseMin(corner), 0.0;
    vehicle.at_start.high << from.cwiseMax(corner), kHeight_m;
    vehicle.velocity << kSpeed_mps * across.normalized(), 0.0;
    vehicle.duration_s = across.norm() / kSpeed_mps;
    const double passes = time_at(route, leg.to_world({x - kAhead_m, 0.0}), duration_s);
    vehicle.start_s = passes - kStart_m / kSpeed_mps;
    vehicles.push_back(vehicle);
    side = -side;
  }
  return vehicles;
}

}  // namespace oneac::simulation
