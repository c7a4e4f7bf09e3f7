#pragma once

#include "drive_record.h"
#include "run_options.h"
#include "run_summary.h"

#include "oneac/base/image.h"
#include "oneac/report/overlay.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace oneac::app {

/// A step worth looking at.
struct WorstFrame {
  std::size_t frame = 0;  ///< of the record; its step leads to it
  std::string reason;     ///< why it was chosen
  bool bad = false;       ///< something went wrong in it
};

/// A step's second image with its correspondences, those that obey the step's pose marked.
struct FramePicture {
  WorstFrame frame;
  Overlay picture;
};

/// Up to `count` bad steps in order of time: those that the images did not carry, those that are in
/// a wrong basin by the reference (PairError::is_bad), those with less than a third of the drive's
/// usual inliers. Without any, the one with the fewest inliers.
[[nodiscard]] std::vector<WorstFrame> worst_frames(const DriveRecord& record,
                                                   const RunEvaluation& evaluation,
                                                   std::size_t count);

/// An image of the log, read once more; empty when it cannot be.
/// @param index  of the camera's images in the log
[[nodiscard]] std::optional<GreyImage> read_image(const RunOptions& options, std::size_t index);

/// Reads the images once more and extracts their correspondences pair by pair, without the history
/// that a tracker had in the drive. Images that cannot be read again are left out.
[[nodiscard]] std::vector<FramePicture> draw_frames(const DriveRecord& record,
                                                    const RunOptions& options,
                                                    const std::vector<WorstFrame>& frames);

}  // namespace oneac::app
