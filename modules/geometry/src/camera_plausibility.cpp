#include "oneac/geometry/camera_plausibility.h"

#include "oneac/base/number_text.h"
#include "oneac/geometry/angles.h"
#include "oneac/geometry/lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace oneac {
namespace {

constexpr double kNarrowest = 10.0 * kDegree;
constexpr double kWidest = 150.0 * kDegree;
constexpr double kMiddleBegins = 0.25, kMiddleEnds = 0.75;  // [-] of the image's side
constexpr double kSquarest = 1.25;  // [-] the longer focal length over the other

std::string whole(double value) {
  return fixed_text(value, 0);
}

/// A tenth of a pixel, but no row of three hundred digits.
std::string pixels(double value) {
  constexpr double kWritable_px = 1e6;
  return std::abs(value) < kWritable_px ? fixed_text(value, 1) : exact_text(value);
}

std::optional<std::string> field_fault(const char* name, double focal, double side) {
  const double field = 2.0 * std::atan(0.5 * side / focal);
  if (field >= kNarrowest && field <= kWidest) return std::nullopt;
  return std::string(name) + " = " + pixels(focal) + " px on " + whole(side) +
         " px of image is a field of view of " + fixed_text(field / kDegree, 1) +
         "°, cameras of vehicles have 10° to 150°";
}

std::optional<std::string> centre_fault(const char* name, double centre, double side) {
  if (centre >= kMiddleBegins * side && centre <= kMiddleEnds * side) return std::nullopt;
  return std::string(name) + " = " + pixels(centre) + " px lies beyond the middle half of " +
         whole(side) + " px of image";
}

/// Both lie a tenth of a side off the middle, and at it, to a thirtieth, with their places changed.
std::optional<std::string> swap_fault(const PinholeCamera& camera) {
  const auto off = [&](double x, double y) {
    return std::array<double, 2>{std::abs(x / camera.width - 0.5),
                                 std::abs(y / camera.height - 0.5)};
  };
  const auto [x_off, y_off] = off(camera.cx, camera.cy);
  const auto [x_swapped, y_swapped] = off(camera.cy, camera.cx);
  const bool swapped = std::min(x_off, y_off) > 0.1 && std::max(x_swapped, y_swapped) < 1.0 / 30.0;
  if (!swapped) return std::nullopt;
  return "cx = " + pixels(camera.cx) + " px and cy = " + pixels(camera.cy) + " px look swapped";
}

std::optional<std::string> aspect_fault(const PinholeCamera& camera) {
  if (std::max(camera.fx, camera.fy) <= kSquarest * std::min(camera.fx, camera.fy)) {
    return std::nullopt;
  }
  return "fx = " + pixels(camera.fx) + " px and fy = " + pixels(camera.fy) +
         " px differ by more than a quarter";
}

constexpr double kShortest_px = 1.0, kFurthest_px = 1e6;
constexpr double kMostAnamorphic = 4.0;
constexpr double kLeastStretch = 0.05, kMostStretch = 20.0, kMostAcross = 1.0;

bool is_possible_focal(double focal) {
  return focal >= kShortest_px && focal <= kFurthest_px;
}

/// Radius [-] of the circle about the axis that fits into the image; 0 without a size.
double inner_radius(const PinholeCamera& camera) {
  if (camera.width <= 0 || camera.height <= 0) return 0.0;
  return 0.5 * std::min(camera.width / camera.fx, camera.height / camera.fy);
}

/// How much further from the axis the lens puts this direction, and how much across.
bool is_possible_at(const PinholeCamera& camera, const Eigen::Vector2d& x) {
  const Eigen::Vector2d seen = distorted(camera, x);
  const double stretch = seen.dot(x) / x.squaredNorm();
  const double across = (seen - stretch * x).norm() / x.norm();
  return stretch >= kLeastStretch && stretch <= kMostStretch && across <= kMostAcross;
}

bool is_possible_lens(const PinholeCamera& camera) {
  const double inner = inner_radius(camera);
  if (!(inner > 0.0)) return true;
  // A fisheye sees farther round than its pixels over the focal length tell.
  const double r = camera.lens == LensModel::kannala_brandt ? std::min(inner, 1.0) : inner;
  return is_possible_at(camera, {r, 0.0}) && is_possible_at(camera, {0.0, r});
}

std::string short_text(double value) {
  return significant_text(value, 6);
}

}  // namespace

std::string impossible_camera(const PinholeCamera& camera) {
  if (!is_possible_focal(camera.fx) || !is_possible_focal(camera.fy)) {
    return "no camera has the focal lengths " + short_text(camera.fx) + " and " +
           short_text(camera.fy) + " px";
  }
  // An anamorphic lens stretches by two.
  if (std::max(camera.fx, camera.fy) > kMostAnamorphic * std::min(camera.fx, camera.fy)) {
    return "no camera has focal lengths as different as " + short_text(camera.fx) + " and " +
           short_text(camera.fy) + " px";
  }
  if (!(std::abs(camera.cx) <= kFurthest_px) || !(std::abs(camera.cy) <= kFurthest_px)) {
    return "no camera has its principal point at " + short_text(camera.cx) + ", " +
           short_text(camera.cy) + " px";
  }
  if (is_possible_lens(camera)) return "";
  std::string k;
  for (const double value : camera.distortion) k += " " + short_text(value);
  return "no lens has the distortion" + k;
}

std::vector<std::string> camera_faults(const PinholeCamera& camera) {
  const double width = camera.width, height = camera.height;
  std::vector<std::string> faults;
  if (!(width > 0.0) || !(height > 0.0)) return faults;
  const bool lies = width >= height;  // a strip cut out of an image is low, and sound
  for (const auto& fault :
       {lies ? field_fault("fx", camera.fx, width) : field_fault("fy", camera.fy, height),
        aspect_fault(camera), swap_fault(camera), centre_fault("cx", camera.cx, width),
        centre_fault("cy", camera.cy, height)}) {
    if (fault) faults.push_back(*fault);
  }
  return faults;
}

}  // namespace oneac
