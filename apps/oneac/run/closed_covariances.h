#pragma once

#include "run_loops.h"

#include "oneac/evaluation/covariance_io.h"

#include <vector>

namespace oneac::app {

/// The closed drive's camera poses with a covariance each: those of closed_covariances() at the
/// keyframes, between two of them what both carry along, by the share of the time; of a drive
/// without loops the record's own.
[[nodiscard]] std::vector<PoseCovarianceRow> closed_camera_poses(const DriveRecord& record,
                                                                 const ClosedDrive& closed);
/// The same of the vehicle.
[[nodiscard]] std::vector<PoseCovarianceRow> closed_vehicle_poses(const DriveRecord& record,
                                                                  const ClosedDrive& closed);

}  // namespace oneac::app
