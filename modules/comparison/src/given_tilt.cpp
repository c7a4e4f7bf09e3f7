#include "oneac/comparison/given_tilt.h"

#include "oneac/evaluation/statistics.h"
#include "oneac/geometry/angles.h"

#include <cmath>
#include <utility>

namespace oneac {
namespace {

// cos 25°: beyond it the car manoeuvres, and the elevation of t mixes with roll.
constexpr double kMainlyForward = 0.9;
// [rad] 15°: a direction of travel further from the given horizon is no drive.
constexpr double kLargestElevation = 0.26;

}  // namespace

Tilt GivenTilt::tilt(const Eigen::Matrix3d& R_vehicle_cam) const {
  if (source == "params") return {pitch_up_deg * kDegree, roll_right_deg * kDegree};
  return tilt_from_mounting(R_vehicle_cam);
}

Tilt corrected_by_travel(const Tilt& given, const std::vector<Eigen::Vector3d>& translations) {
  std::vector<double> elevations;
  for (const Eigen::Vector3d& t : translations) {
    if (!(t.norm() > 0.0)) continue;
    // Points move against the camera; backwards is the same line.
    Eigen::Vector3d travel = levelling_rotation(given) * -t.normalized();
    if (travel.z() < 0.0) travel = -travel;
    // A camera pitched up sees its travel below the axis, Y down.
    const double elevation = std::atan2(travel.y(), travel.z());
    if (travel.z() > kMainlyForward && std::abs(elevation) < kLargestElevation) {
      elevations.push_back(elevation);
    }
  }
  if (elevations.empty()) return given;
  return {given.pitch_up + percentile(std::move(elevations), 50.0), given.roll_right};
}

}  // namespace oneac
