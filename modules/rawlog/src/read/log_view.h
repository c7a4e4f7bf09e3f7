#pragma once

#include "images/log_image.h"
#include "read/log_reader.h"

#include "oneac/observations/camera_view.h"

#include <memory>
#include <vector>

namespace oneac {

/// A view whose image GuardedStream took out of the record. Borrows from the record.
struct LogView : CameraView {
  std::shared_ptr<const LogImage> image;  ///< never null
};

/// The images of a record: none, one, or the left and right one of a pair.
[[nodiscard]] std::vector<LogView> log_views(const RawlogRecord& record);

/// @throws std::runtime_error when the pose of a camera is not finite or not a rotation
void check_cameras(const mrpt::obs::CObservation& observation);

}  // namespace oneac
