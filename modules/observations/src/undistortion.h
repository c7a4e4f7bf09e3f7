#pragma once

#include "oneac/base/image.h"
#include "oneac/geometry/camera.h"

#include <opencv2/core.hpp>

#include <mutex>
#include <string>

namespace oneac {

/// The fields of view that an undistorted image may be given [deg]: those of a vehicle's pinhole
/// camera, see camera_faults().
inline constexpr double kNarrowestView_deg = 10.0;
inline constexpr double kWidestView_deg = 150.0;

struct UndistorterOptions {
  double fov_deg = 0.0;   ///< across the undistorted image; 0: chosen, see undistorted_pinhole()
  bool scalable = false;  ///< the calibration may be that of the same images in another size
};

/// The pinhole camera to which images of a distorted one are undistorted: of the same size and
/// centre, with the same focal lengths where that keeps the road, i.e. nine tenths of the lower
/// half at least. Where it does not (fisheye, wide lenses), both are shortened until the lower edge
/// of the image is seen again, but not beyond 120° across, where a pinhole image is mostly rim.
/// @param fov_deg  not 0: the focal lengths are those of this field of view across
[[nodiscard]] PinholeCamera undistorted_pinhole(const PinholeCamera& camera, double fov_deg);

/// Makes the images of one camera rectified: those of a distorted camera are remapped (map computed
/// once), the others only checked. Thread-safe.
class Undistorter {
 public:
  explicit Undistorter(const PinholeCamera& camera, const UndistorterOptions& options = {})
      : camera_(camera), options_(options) {}

  /// @throws InputError naming the image when its size is not the calibration's or, where that is
  ///         not known or scaled, not that of the images before
  [[nodiscard]] GreyImage rectify(GreyImage grey, const std::string& name) const;
  /// Dark where the image as it is stored gives rectified images nothing (a rim of black, where
  /// the pinhole camera sees more than the lens), with as much beside it as comparisons of patches
  /// would reach over; empty where all of them is seen.
  [[nodiscard]] GreyImage unseen(const GreyImage& image) const;
  /// The camera of the rectified images.
  [[nodiscard]] PinholeCamera rectified_camera(const GreyImage& image) const;
  /// The camera of the images as they are stored, scaled to their size where it may be.
  [[nodiscard]] PinholeCamera camera_for(int width, int height) const;
  /// One line once an image has made the calibration be scaled, else "".
  [[nodiscard]] std::string scaling_note() const;

 private:
  void check_size(const GreyImage& grey, const std::string& name) const;
  void prepare(int width, int height) const;
  void compute_map(const PinholeCamera& camera, const cv::Size& size) const;
  [[nodiscard]] GreyImage remapped(const GreyImage& stored) const;
  [[nodiscard]] GreyImage rim(const cv::Size& size) const;

  PinholeCamera camera_;
  UndistorterOptions options_;
  mutable std::once_flag prepared_;
  mutable std::mutex noted_;
  mutable cv::Size size_;            ///< of the first image
  mutable PinholeCamera rectified_;  ///< of the images
  mutable std::string scaling_note_;
  mutable cv::Mat map1_;
  mutable cv::Mat map2_;
  mutable GreyImage unseen_;
};

}  // namespace oneac
