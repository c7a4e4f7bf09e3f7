#pragma once

#include "oneac/geometry/levelling.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace oneac {

/// Where a comparison takes the camera's tilt from.
struct GivenTilt {
  std::string source = "log";   ///< "params": the two angles below; else the log's sensor pose
  double pitch_up_deg = 0.0;    ///< [deg] optical axis above the horizon
  double roll_right_deg = 0.0;  ///< [deg] camera leaning to its right
  bool refine = true;           ///< correct the pitch by the direction of travel

  /// Before any correction.
  [[nodiscard]] Tilt tilt(const Eigen::Matrix3d& R_vehicle_cam) const;
};

template <class Visitor>
void describe(Visitor&& visit, GivenTilt& o) {
  visit("source", o.source, "name", "params: the angles below; else the log's sensor pose");
  visit("pitch_up_deg", o.pitch_up_deg, "deg", "optical axis above the horizon");
  visit("roll_right_deg", o.roll_right_deg, "deg", "camera leaning to its right");
  visit("refine", o.refine, "bool", "correct the pitch by the direction of travel");
}

/// The tilt with its pitch corrected: a vehicle travels along its road, so the median elevation of
/// its direction of travel is the error of the pitch. Steps that are not mainly forward, or steep,
/// are ignored; without others the tilt stays.
/// @param translations  of T_2_1 of the (tilted) camera, any length
[[nodiscard]] Tilt corrected_by_travel(const Tilt& given,
                                       const std::vector<Eigen::Vector3d>& translations);

}  // namespace oneac
