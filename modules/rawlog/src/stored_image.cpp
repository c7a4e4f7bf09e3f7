#include "stored_image.h"

#include "image_decoding.h"

#include <Eigen/Geometry>

#include <cmath>

namespace oneac {
namespace {

constexpr double kParallel = 1e-3;  // [rad] between rectified cameras
constexpr double kShortest = 1e-3;  // [m] of a baseline
constexpr double kSideways = 0.01;  // [-] of the baseline, off the X axis
constexpr double kSamePixel = 0.1;  // [px] between the calibrations of a rectified pair

bool is_like(const mrpt::img::TCamera& right, const PinholeCamera& left) {
  const double off = std::abs(right.fx() - left.fx) + std::abs(right.fy() - left.fy) +
                     std::abs(right.cx() - left.cx) + std::abs(right.cy() - left.cy);
  return off < kSamePixel;
}

}  // namespace

std::string StoredImage::name(const std::string& name_in_log) const {
  return file.empty() ? name_in_log : file.string();
}

cv::Mat StoredImage::grey(const std::string& name_in_log) const {
  return file.empty() ? decode_grey(*in_log, name_in_log) : decode_grey_file(file);
}

std::optional<StoredImage> stored_image(const CameraView& view, ExternalImages& images) {
  if (view.image->kind == LogImage::Kind::none) return std::nullopt;
  if (view.image->kind != LogImage::Kind::external) return StoredImage{{}, view.image};
  const auto file = images.find(view.image->file);
  if (!file) return std::nullopt;
  return StoredImage{*file, view.image};
}

std::optional<double> rectified_baseline(const CameraView& right, const PinholeCamera& left,
                                         bool overridden) {
  if (left.is_distorted() || (!overridden && !is_like(*right.calibration, left))) {
    return std::nullopt;
  }
  const Eigen::Isometry3d T = right.offset_in_pair(true);
  const Eigen::Vector3d t = T.translation();
  const bool parallel = Eigen::AngleAxisd(T.linear()).angle() < kParallel;
  const bool beside = t.x() > kShortest && t.tail<2>().norm() < kSideways * t.x();
  if (!parallel || !beside) return std::nullopt;
  return t.x();
}

}  // namespace oneac
