#include "oneac/geometry/lens.h"

#include "oneac/geometry/lens_model.h"

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

constexpr double kWidest = 1.55;  // [rad] of a direction that a pinhole camera has: 89°
constexpr int kIterations = 50;
constexpr double kTolerance = 1e-10;

/// Newton on the angle to the axis.
std::optional<Eigen::Vector2d> undistorted_fisheye(const PinholeCamera& camera,
                                                   const Eigen::Vector2d& x) {
  const auto& k = camera.distortion;
  const double wanted = x.norm();
  if (!std::isfinite(wanted)) return std::nullopt;
  if (wanted < kTolerance) return x;
  double angle = wanted;
  for (int i = 0; i < kIterations; ++i) {
    const double a2 = angle * angle;
    const double there = angle * (1.0 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))));
    const double slope =
        1.0 + a2 * (3.0 * k[0] + a2 * (5.0 * k[1] + a2 * (7.0 * k[2] + a2 * 9.0 * k[3])));
    if (!(slope > 0.0) || !(angle < kWidest)) return std::nullopt;
    if (std::abs(there - wanted) < kTolerance) return x * (std::tan(angle) / wanted);
    angle += (wanted - there) / slope;
  }
  return std::nullopt;
}

/// Fixed-point iteration.
std::optional<Eigen::Vector2d> undistorted_polynomial(const PinholeCamera& camera,
                                                      const Eigen::Vector2d& wanted) {
  Eigen::Vector2d x = wanted;
  for (int i = 0; i < kIterations && x.allFinite(); ++i) {
    const Eigen::Vector2d missing = wanted - distorted(camera, x);
    if (missing.norm() < kTolerance) return x;
    x += missing;
  }
  return std::nullopt;
}

}  // namespace

Eigen::Vector2d distorted(const PinholeCamera& camera, const Eigen::Vector2d& x) {
  Eigen::Vector2d there;
  distort(camera.lens, camera.distortion.data(), x.x(), x.y(), there.data());
  return there;
}

std::optional<Eigen::Vector2d> undistorted(const PinholeCamera& camera, const Eigen::Vector2d& x) {
  return camera.lens == LensModel::kannala_brandt ? undistorted_fisheye(camera, x)
                                                  : undistorted_polynomial(camera, x);
}

bool is_five_term_lens(const PinholeCamera& camera) {
  constexpr std::ptrdiff_t kFive = 5;
  return camera.lens == LensModel::plumb_bob &&
         std::all_of(camera.distortion.begin() + kFive, camera.distortion.end(),
                     [](double k) { return k == 0.0; });
}

}  // namespace oneac
