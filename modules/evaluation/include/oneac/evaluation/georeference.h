#pragma once

#include "oneac/evaluation/trajectory_errors.h"
#include "oneac/evaluation/trajectory_io.h"

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace oneac {

/// Where a receiver was at a moment.
struct PositionFix {
  double time_s = 0.0;                            ///< Unix time [s]
  Eigen::Vector3d enu = Eigen::Vector3d::Zero();  ///< east, north, up of some origin [m]
};

/// How the world of a drive lies on the earth: enu = enu_drive * position.
struct Georeference {
  Similarity enu_drive;    ///< a turn about the vertical, a shift; scale 1 of a metric drive
  std::size_t fixes = 0;   ///< that were compared
  double rms = 0.0;        ///< [m] horizontal distance of fixes from the drive, all of them
  double median = 0.0;     ///< [m]
  double max = 0.0;        ///< [m]
  double yaw_sigma = 0.0;  ///< [rad] 1σ of the turn
};

/// The georeference, or why there is none.
struct GeoreferenceResult {
  bool found = false;
  Georeference georeference;  ///< where found
  std::string reason;         ///< one line, where not
};

/// Joins a drive to the fixes of a GPS by robust least squares (Huber): in metres by SE(2) and a
/// height, else by a similarity. Fixes are compared with the straight motion between the frames
/// around them; the antenna is taken to be at the vehicle's origin.
///
/// No answer from fewer than five fixes, from a drive that covers too little ground for its
/// direction (ten metres, or five times what the fixes scatter by), or from none in common.
/// @param vehicle  T_world_vehicle, Z up, with times
/// @param metric   its lengths are metres
[[nodiscard]] GeoreferenceResult georeference(const Trajectory& vehicle,
                                              const std::vector<PositionFix>& fixes, bool metric);

/// The drive in the frame of the fixes.
[[nodiscard]] Trajectory in_enu(const Trajectory& vehicle, const Georeference& georeference);

}  // namespace oneac
