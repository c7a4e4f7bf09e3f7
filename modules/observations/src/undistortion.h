#pragma once

#include "oneac/base/image.h"
#include "oneac/geometry/camera.h"

#include <opencv2/core.hpp>

#include <mutex>
#include <string>

namespace oneac {

/// Makes the images of one camera rectified: those of a distorted camera are remapped (map computed
/// once), the others only checked. Thread-safe.
class Undistorter {
 public:
  explicit Undistorter(const PinholeCamera& camera) : camera_(camera) {}

  /// @throws InputError naming the image when its size is not the calibration's or, where that is
  ///         not known, not that of the images before
  [[nodiscard]] GreyImage rectify(GreyImage grey, const std::string& name) const;
  /// The camera of the rectified images: the same focal lengths and centre, no distortion.
  [[nodiscard]] PinholeCamera rectified_camera(const GreyImage& image) const;

 private:
  void check_size(const GreyImage& grey, const std::string& name) const;
  void compute_map(const cv::Size& size) const;

  PinholeCamera camera_;
  mutable std::once_flag prepared_;
  mutable cv::Size size_;  ///< of the first image
  mutable cv::Mat map1_;
  mutable cv::Mat map2_;
};

}  // namespace oneac
