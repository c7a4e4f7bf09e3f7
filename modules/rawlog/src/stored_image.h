#pragma once

#include "camera_view.h"
#include "external_images.h"
#include "log_image.h"

#include <opencv2/core.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace oneac {

/// An image to be loaded: the file of an external one, or what the log holds.
struct StoredImage {
  std::filesystem::path file;
  std::shared_ptr<const LogImage> in_log;

  /// @param name_in_log  for messages about an image of the log
  /// @throws InputError when it cannot be decoded
  [[nodiscard]] cv::Mat grey(const std::string& name_in_log) const;
  [[nodiscard]] std::string name(const std::string& name_in_log) const;
};

/// Empty when the file is not there, or the log holds no pixels.
[[nodiscard]] std::optional<StoredImage> stored_image(const CameraView& view,
                                                      ExternalImages& images);

/// Baseline [m] of a pair whose rows correspond: parallel, side by side, equal calibrations; empty
/// for any other pair, and for one whose images are not rectified.
/// @param overridden  the calibration is not the log's; then it is that of both images
[[nodiscard]] std::optional<double> rectified_baseline(const CameraView& right,
                                                       const PinholeCamera& left, bool overridden);

}  // namespace oneac
