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
constexpr double kBusAhead_m = 6.5;    // of the car's origin: 5 m before a bumper
constexpr double kBusSpeed_mps = 4.0;  // round a corner
constexpr double kBusLength_m = 12.0;
constexpr double kBusWidth_m = 2.5;
constexpr double kBusHeight_m = 3.2;
constexpr double kFirstBus_s = 1.5;   // after the car has stopped
constexpr double kBusEvery_s = 4.5;   // one way and the other in turn
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

/// Where a leg is crossed, how far to the side it begins, and with which block.
struct Crossing {
  double x;         ///< along the leg, of the block's rear side [m]
  double side;      ///< 1: from the left
  double from_m;    ///< [m] beside the lane
  double length_m;  ///< of the block, across the leg
  double width_m;
  double height_m;
};

/// Starts at start_s, stops as far on the other side.
MovingVehicle crossing_vehicle(const Leg& leg, const Crossing& crossing, double speed_mps,
                               double start_s) {
  const auto& [x, side, from_m, length_m, width_m, height_m] = crossing;
  const Eigen::Vector2d from = leg.to_world({x, side * from_m});
  const Eigen::Vector2d across = leg.to_world({x, -side * from_m}) - from;
  const Eigen::Vector2d corner = leg.to_world({x + width_m, side * (from_m + length_m)});
  MovingVehicle vehicle;
  vehicle.at_start.kind = Box::Kind::kVehicle;
  vehicle.at_start.low << from.cwiseMin(corner), 0.0;
  vehicle.at_start.high << from.cwiseMax(corner), height_m;
  Eigen::Vector3d velocity;
  velocity << speed_mps * across.normalized(), 0.0;
  const double duration_s = across.norm() / speed_mps;
  vehicle.shift = [velocity, start_s, duration_s](double time_s) -> Eigen::Vector3d {
    return std::clamp(time_s - start_s, 0.0, duration_s) * velocity;
  };
  return vehicle;
}

}  // namespace

Box MovingVehicle::at(double time_s) const {
  const Eigen::Vector3d moved = shift(time_s);
  Box box = at_start;
  box.low += moved;
  box.high += moved;
  return box;
}

std::vector<MovingVehicle> crossing_traffic(const Route& route, double duration_s) {
  std::vector<MovingVehicle> vehicles;
  double side = 1.0;
  for (const Leg& leg : route.legs()) {
    const double x = kPlace * leg.length_m;
    const double passes = time_at(route, leg.to_world({x - kAhead_m, 0.0}), duration_s);
    vehicles.push_back(crossing_vehicle(leg, {x, side, kStart_m, kLength_m, kWidth_m, kHeight_m},
                                        kSpeed_mps, passes - kStart_m / kSpeed_mps));
    side = -side;
  }
  return vehicles;
}

std::vector<MovingVehicle> crossing_buses(const Route& route) {
  std::vector<MovingVehicle> buses;
  for (const Stop& stop : route.stops()) {
    const double x = stop.x + kBusAhead_m;
    double side = 1.0;
    double passes = stop.time_s + kFirstBus_s;  // its front is before the camera
    while (passes + kBusLength_m / kBusSpeed_mps < stop.time_s + stop.wait_s) {
      buses.push_back(crossing_vehicle(stop.leg,
                                       {x, side, kStart_m, kBusLength_m, kBusWidth_m, kBusHeight_m},
                                       kBusSpeed_mps, passes - kStart_m / kBusSpeed_mps));
      buses.back().at_start.kind = Box::Kind::kTruck;
      passes += kBusEvery_s;
      side = -side;
    }
  }
  return buses;
}

}  // namespace oneac::simulation
