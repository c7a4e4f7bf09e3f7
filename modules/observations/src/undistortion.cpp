#include "undistortion.h"

#include "oneac/base/error.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace oneac {
namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

void Undistorter::compute_map(const cv::Size& size) const {
  const cv::Matx33d K(camera_.fx, 0, camera_.cx, 0, camera_.fy, camera_.cy, 0, 0, 1);
  const cv::Mat k(1, static_cast<int>(camera_.distortion.size()), CV_64F,
                  const_cast<double*>(camera_.distortion.data()));
  cv::initUndistortRectifyMap(K, k, cv::noArray(), K, size, CV_16SC2, map1_, map2_);
}

void Undistorter::check_size(const GreyImage& grey, const std::string& name) const {
  const bool size_known = camera_.width > 0 && camera_.height > 0;
  if (size_known && (grey.width() != camera_.width || grey.height() != camera_.height)) {
    throw InputError(name,
                     "the image is " + size_text(grey.width(), grey.height()) +
                         " but its calibration is for " + size_text(camera_.width, camera_.height),
                     "give the calibration of these images with --calibration FILE[:SECTION], or "
                     "set the observations' cameraParams");
  }
  const cv::Size size(grey.width(), grey.height());
  std::call_once(prepared_, [&] {
    size_ = size;
    if (camera_.is_distorted()) compute_map(size);
  });
  if (size_ == size) return;
  throw InputError(name, "the size of the images changes within the log",
                   "give a calibration with the size of its images");
}

GreyImage Undistorter::rectify(GreyImage grey, const std::string& name) const {
  check_size(grey, name);
  if (!camera_.is_distorted()) return grey;
  GreyImage rectified(grey.width(), grey.height());
  const cv::Mat from(grey.height(), grey.width(), CV_8U, grey.row(0));
  cv::Mat to(rectified.height(), rectified.width(), CV_8U, rectified.row(0));
  cv::remap(from, to, map1_, map2_, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  return rectified;
}

PinholeCamera Undistorter::rectified_camera(const GreyImage& image) const {
  PinholeCamera camera = camera_;
  camera.width = image.width();
  camera.height = image.height();
  camera.distortion.fill(0.0);
  return camera;
}

}  // namespace oneac
