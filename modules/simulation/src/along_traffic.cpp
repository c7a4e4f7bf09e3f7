#include "along_traffic.h"

#include "random_numbers.h"

#include <cmath>

namespace oneac::simulation {
namespace {

constexpr double kLane = 3.7;            // [m] middle of the left lane
constexpr double kPassing_mps = 5.0;     // faster than the car's cruising speed
constexpr double kOncoming_mps = 10.0;   // a road through a town
constexpr double kPassingEvery_s = 3.0;  // dense traffic
constexpr double kOncomingEvery_s = 1.8;
constexpr double kFirst_s = 1.0;
constexpr double kAfterwards_s = 12.0;  // still in view when the drive ends
constexpr double kTruckLength_m = 9.0;
constexpr double kTruckWidth_m = 2.5;
constexpr double kTruckHeight_m = 3.5;
constexpr double kSwing_s = 12.0;  // period: relative speeds of some decimetres a second
constexpr double kTwoPi = 6.283185307179586;

Box block(double x, double y, const Eigen::Vector3d& size, Box::Kind kind) {
  Box box;
  box.kind = kind;
  box.low << x, y - 0.5 * size.y(), 0.0;
  box.high << x + size.x(), y + 0.5 * size.y(), size.z();
  return box;
}

struct Stream {
  double speed_mps;  ///< along X, negative: towards the car
  double every_s;
};

std::vector<MovingVehicle> stream(const Route& route, double duration_s, const Stream& wanted) {
  RandomNumbers random(0x73747265616dULL);
  std::vector<MovingVehicle> vehicles;
  double meets_s = kFirst_s;
  while (meets_s < duration_s + kAfterwards_s) {
    const bool van = random.chance(0.35);
    const Eigen::Vector3d size =
        van ? Eigen::Vector3d(5.6, 2.0, 2.5) : Eigen::Vector3d(random.uniform(4.0, 4.8), 1.8, 1.5);
    MovingVehicle vehicle;
    vehicle.at_start = block(route.at(meets_s).position.x(), kLane, size, Box::Kind::kVehicle);
    vehicle.shift = [meets_s, speed = wanted.speed_mps](double time_s) -> Eigen::Vector3d {
      return {speed * (time_s - meets_s), 0.0, 0.0};
    };
    vehicles.push_back(vehicle);
    meets_s += wanted.every_s;
  }
  return vehicles;
}

}  // namespace

std::vector<MovingVehicle> overtaking_traffic(const Route& route, double duration_s) {
  return stream(route, duration_s, {route.cruise_mps() + kPassing_mps, kPassingEvery_s});
}

std::vector<MovingVehicle> oncoming_traffic(const Route& route, double duration_s) {
  return stream(route, duration_s, {-kOncoming_mps, kOncomingEvery_s});
}

std::vector<MovingVehicle> truck_ahead(const SimulationOptions& options, const Route& route) {
  MovingVehicle truck;
  truck.at_start =
      block(0.0, 0.0, {kTruckLength_m, kTruckWidth_m, kTruckHeight_m}, Box::Kind::kTruck);
  truck.shift = [route, from = options.camera_forward_m, gap = options.truck_gap_m,
                 swing = options.truck_gap_swing_m](double time_s) -> Eigen::Vector3d {
    const double now = gap + swing * std::sin(kTwoPi * time_s / kSwing_s);
    return {route.at(time_s).position.x() + from + now, 0.0, 0.0};
  };
  return {truck};
}

std::vector<MovingVehicle> traffic_of(const SimulationOptions& options, const Route& route,
                                      double duration_s) {
  switch (options.traffic) {
    case Traffic::kCrossing:
      return crossing_traffic(route, duration_s);
    case Traffic::kOvertaking:
      return overtaking_traffic(route, duration_s);
    case Traffic::kOncoming:
      return oncoming_traffic(route, duration_s);
    case Traffic::kTruck:
      return truck_ahead(options, route);
    case Traffic::kBus:
      return crossing_buses(route);
    default:
      return {};
  }
}

}  // namespace oneac::simulation
