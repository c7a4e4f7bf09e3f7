#include "undistortion.h"

#include "oneac/base/error.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace oneac {
namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

GreyImage copy_of(const cv::Mat& grey) {
  return GreyImage(ImageView{grey.data, grey.cols, grey.rows, static_cast<int>(grey.step)});
}

}  // namespace

void Undistorter::compute_map(const cv::Size& size) const {
  const cv::Matx33d K(camera_.fx, 0, camera_.cx, 0, camera_.fy, camera_.cy, 0, 0, 1);
  const cv::Mat k(1, static_cast<int>(camera_.distortion.size()), CV_64F,
                  const_cast<double*>(camera_.distortion.data()));
  cv::initUndistortRectifyMap(K, k, cv::noArray(), K, size, CV_16SC2, map1_, map2_);
}

GreyImage Undistorter::rectify(const cv::Mat& grey, const std::string& name) const {
  const bool size_known = camera_.width > 0 && camera_.height > 0;
  if (size_known && (grey.cols != camera_.width || grey.rows != camera_.height)) {
    throw InputError(name,
                     "the image is " + size_text(grey.cols, grey.rows) +
                         " but its calibration is for " + size_text(camera_.width, camera_.height),
                     "give the calibration of these images with --calibration FILE[:SECTION]");
  }
  if (!camera_.is_distorted()) return copy_of(grey);
  std::call_once(map_computed_, [&] { compute_map(grey.size()); });
  if (map1_.size() != grey.size()) {
    throw InputError(name, "the size of the images changes within the log",
                     "give a calibration with the size of its images");
  }
  cv::Mat rectified;
  cv::remap(grey, rectified, map1_, map2_, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  return copy_of(rectified);
}

PinholeCamera Undistorter::rectified_camera(const GreyImage& image) const {
  PinholeCamera camera = camera_;
  camera.width = image.width();
  camera.height = image.height();
  camera.distortion.fill(0.0);
  return camera;
}

}  // namespace oneac
