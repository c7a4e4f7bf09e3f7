#include "undistortion.h"

#include "oneac/base/error.h"
#include "oneac/geometry/lens.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace oneac {
namespace {

constexpr double kRoadKept = 0.9;          // of the lower half: what is lost is the bonnet's rim
constexpr double kWidestChosen_deg = 120;  // across; from here on a pinhole image is mostly rim
constexpr std::size_t kFisheyeTerms = 4;
// [px] As far as corners keep from the edges of an image. Nearer to it the rim would be one edge of
// their patches, and stand still while the car travels.
constexpr int kRimReach = 12;

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

cv::Matx33d matrix_of(const PinholeCamera& camera) {
  return {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
}

bool is_fisheye(const PinholeCamera& camera) {
  return camera.lens == LensModel::kannala_brandt;
}

cv::Mat coefficients(const PinholeCamera& camera) {
  const std::size_t terms = is_fisheye(camera) ? kFisheyeTerms : camera.distortion.size();
  const std::vector<double> values(camera.distortion.begin(),
                                   camera.distortion.begin() + static_cast<std::ptrdiff_t>(terms));
  return cv::Mat(values, true).t();
}

/// Where the lens puts the direction (0, y, 1) [px], from the optical axis downwards.
double pixels_below(const PinholeCamera& camera, double y) {
  return camera.fy * distorted(camera, {0.0, y}).y();
}

/// Slope y of the direction (0, y, 1) that the middle of the lower edge sees; empty when it looks
/// so far down that no pinhole image reaches it, or the polynomial turns back before.
std::optional<double> slope_of_lower_edge(const PinholeCamera& camera) {
  const double edge_px = camera.height - 1 - camera.cy;
  const double steepest = std::tan(0.5 * kWidestView_deg * CV_PI / 180.0);
  constexpr int kSteps = 1000;
  double before = 0.0;
  for (int i = 1; i <= kSteps; ++i) {  // the first crossing: beyond a fold the lens sees nothing
    const double y = steepest * i / kSteps;
    const double below = pixels_below(camera, y);
    if (below >= edge_px) {
      return y - steepest / kSteps * (below - edge_px) / (below - before);
    }
    if (!(below > before)) return std::nullopt;
    before = below;
  }
  return std::nullopt;
}

double focal_factor(const PinholeCamera& camera, double fov_deg) {
  const double across = 0.5 * camera.width / std::tan(0.5 * fov_deg * CV_PI / 180.0);
  return across / camera.fx;
}

/// By how much to shorten the focal lengths, so that the lower edge is in the image.
double road_factor(const PinholeCamera& camera) {
  const double edge_px = camera.height - 1 - camera.cy;
  const auto slope = slope_of_lower_edge(camera);
  if (!slope || edge_px <= 0.0) return is_fisheye(camera) ? 0.0 : 1.0;
  const double kept = edge_px / (camera.fy * *slope);
  return kept >= kRoadKept ? 1.0 : kept;
}

double chosen_factor(const PinholeCamera& camera) {
  const double widest = focal_factor(camera, kWidestChosen_deg);
  // A lens that is no fisheye's has its own centre's focal length at most, however wide.
  const double bound = is_fisheye(camera) ? widest : std::min(1.0, widest);
  return std::max(road_factor(camera), bound);
}

}  // namespace

PinholeCamera undistorted_pinhole(const PinholeCamera& camera, double fov_deg) {
  PinholeCamera pinhole = camera;
  pinhole.distortion.fill(0.0);
  pinhole.lens = LensModel::plumb_bob;
  if (!camera.is_distorted()) return pinhole;
  const double factor = fov_deg > 0.0 ? focal_factor(camera, fov_deg) : chosen_factor(camera);
  pinhole.fx *= factor;
  pinhole.fy *= factor;
  return pinhole;
}

PinholeCamera Undistorter::camera_for(int width, int height) const {
  PinholeCamera camera = camera_;
  if (options_.scalable) camera = resized(camera_, width, height).value_or(camera_);
  camera.width = width;
  camera.height = height;
  return camera;
}

void Undistorter::compute_map(const PinholeCamera& camera, const cv::Size& size) const {
  const cv::Matx33d K = matrix_of(camera);
  const cv::Matx33d to = matrix_of(rectified_);
  const cv::Mat k = coefficients(camera);
  if (is_fisheye(camera)) {
    cv::fisheye::initUndistortRectifyMap(K, k, cv::Matx33d::eye(), to, size, CV_16SC2, map1_,
                                         map2_);
  } else {
    cv::initUndistortRectifyMap(K, k, cv::noArray(), to, size, CV_16SC2, map1_, map2_);
  }
}

void Undistorter::prepare(int width, int height) const {
  std::call_once(prepared_, [&] {
    size_ = {width, height};
    const PinholeCamera camera = camera_for(width, height);
    rectified_ = undistorted_pinhole(camera, options_.fov_deg);
    if (camera.is_distorted()) {
      compute_map(camera, size_);
      unseen_ = rim(size_);
    }
    if (camera.fx == camera_.fx && camera.fy == camera_.fy) return;
    const std::lock_guard lock(noted_);
    scaling_note_ = "the images are " + size_text(width, height) + ", their calibration is for " +
                    size_text(camera_.width, camera_.height) +
                    " and was scaled to them: give their own if they were cropped";
  });
}

void Undistorter::check_size(const GreyImage& grey, const std::string& name) const {
  const bool known = camera_.width > 0 && camera_.height > 0;
  const bool other = known && (grey.width() != camera_.width || grey.height() != camera_.height);
  const std::string sizes = "the image is " + size_text(grey.width(), grey.height()) +
                            " but its calibration is for " +
                            size_text(camera_.width, camera_.height);
  const bool scaled =
      other && options_.scalable && resized(camera_, grey.width(), grey.height()).has_value();
  if (other && !scaled) {
    throw InputError(name, sizes,
                     "give the calibration of these images with --calibration FILE[:SECTION], or "
                     "set the observations' cameraParams");
  }
  prepare(grey.width(), grey.height());
  if (size_ == cv::Size(grey.width(), grey.height())) return;
  throw InputError(name, "the size of the images changes within the log",
                   "give a calibration with the size of its images");
}

GreyImage Undistorter::rectify(GreyImage grey, const std::string& name) const {
  check_size(grey, name);
  if (!camera_.is_distorted()) return grey;
  return remapped(grey);
}

GreyImage Undistorter::remapped(const GreyImage& stored) const {
  GreyImage rectified(stored.width(), stored.height());
  const ImageView view = stored.view();
  // OpenCV has no matrices of constant pixels; these are only read.
  const cv::Mat from(view.height, view.width, CV_8U, const_cast<std::uint8_t*>(view.data));
  cv::Mat to(rectified.height(), rectified.width(), CV_8U, rectified.row(0));
  cv::remap(from, to, map1_, map2_, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  return rectified;
}

GreyImage Undistorter::rim(const cv::Size& size) const {
  constexpr std::uint8_t kWhite = 255;
  GreyImage seen = remapped(GreyImage(size.width, size.height, kWhite));
  cv::Mat mask(size, CV_8U, seen.row(0));
  mask = mask == kWhite;  // a pixel that is mixed with black is no picture of the scene either
  if (cv::countNonZero(mask) == mask.rows * mask.cols) return {};
  const int side = 2 * kRimReach + 1;
  cv::erode(mask.clone(), mask, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
  return seen;
}

GreyImage Undistorter::unseen(const GreyImage& image) const {
  prepare(image.width(), image.height());
  return unseen_;
}

PinholeCamera Undistorter::rectified_camera(const GreyImage& image) const {
  prepare(image.width(), image.height());
  return rectified_;
}

std::string Undistorter::scaling_note() const {
  const std::lock_guard lock(noted_);
  return scaling_note_;
}

}  // namespace oneac
