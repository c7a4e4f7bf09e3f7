#pragma once

#include "route.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace oneac::simulation {

/// A block on the ground with sides along the axes of the world.
struct Box {
  Eigen::Vector3d low;   ///< corner [m]; z = 0
  Eigen::Vector3d high;  ///< opposite corner [m]
  enum class Kind { kBuilding, kVehicle, kPost, kFarBuilding, kTruck } kind = Kind::kBuilding;
};

/// Half of the street's cross-section, from the vehicle's lane outwards [m].
struct CrossSection {
  static constexpr double kRightEdge = -2.0;  ///< right edge line
  static constexpr double kCentreLine = 1.8;  ///< dashed
  static constexpr double kLeftEdge = 5.6;    ///< left edge line
};

/// From what a town follows.
struct TownPlan {
  std::uint64_t seed = 1;
  bool alike = false;           ///< every building of one size, every street as the first
  bool other_vehicles = false;  ///< the same buildings, other things at the kerbs
};

/// Rows of buildings on both sides of every street, running on beyond its ends so that they close
/// the view across the junctions; parked vehicles, bins and posts at the kerbs. Nothing stands in
/// the way.
[[nodiscard]] std::vector<Box> lay_out_street(const Route& route, const TownPlan& plan);

/// Houses that stand at least 110 m from the route, and a lamp post now and then.
[[nodiscard]] std::vector<Box> lay_out_open_land(const Route& route, std::uint64_t seed);

}  // namespace oneac::simulation
