#pragma once

#include "oneac/evaluation/trajectory_io.h"

#include <Eigen/Geometry>

namespace oneac::app {

/// Thirty seconds at ten poses a second, on the spot. @param heading  [rad] at a time from the
/// start [s], counter-clockwise
template <class Heading>
Trajectory turning_vehicle(double start_s, Heading&& heading) {
  Trajectory trajectory;
  for (int i = 0; i < 300; ++i) {
    trajectory.times.push_back(start_s + 0.1 * i);
    trajectory.poses.emplace_back(Eigen::AngleAxisd(heading(0.1 * i), Eigen::Vector3d::UnitZ()));
  }
  return trajectory;
}

}  // namespace oneac::app
