#pragma once

#include "drive_record.h"
#include "run_summary.h"

#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace oneac::app {

/// The reference's camera pose of each frame of a run, where it has one.
struct ReferenceTrack {
  std::vector<std::optional<Eigen::Isometry3d>> poses;  ///< as many as frames; none: no reference
};

/// Associates by time when the reference has times, else by the image's index.
[[nodiscard]] ReferenceTrack reference_track(const DriveRecord& record,
                                             const RunEvaluation& evaluation);

}  // namespace oneac::app
