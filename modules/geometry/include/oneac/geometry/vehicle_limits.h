#pragma once

namespace oneac {

/// What a vehicle on a road does at most.
struct VehicleLimits {
  static constexpr double kFastest = 70.0;              ///< [m/s] 250 km/h, an unlimited motorway
  static constexpr double kHardestAcceleration = 12.0;  ///< [m/s²] what the best tyres give
};

}  // namespace oneac
