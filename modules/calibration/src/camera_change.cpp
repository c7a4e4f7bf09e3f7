#include "oneac/calibration/camera_change.h"

#include "oneac/calibration/intrinsics.h"

namespace oneac {
namespace {

constexpr double kDelta = 1e-5;  // [-] of central differences

}  // namespace

Eigen::Vector2d CameraChange::operator()(const Eigen::Vector2d& x) const {
  const Eigen::Vector2d u = project_distorted(from_, x);
  const Eigen::Vector2d there = normalise_distorted(to_, u);
  return there.allFinite() ? there : to_.normalise(u);
}

Eigen::Matrix2d CameraChange::derivative(const Eigen::Vector2d& x) const {
  const Eigen::Vector2d dx(kDelta, 0.0), dy(0.0, kDelta);
  Eigen::Matrix2d J;
  J.col(0) = ((*this)(x + dx) - (*this)(x - dx)) / (2.0 * kDelta);
  J.col(1) = ((*this)(x + dy) - (*this)(x - dy)) / (2.0 * kDelta);
  return J;
}

PinholeCamera with_longer_focal(PinholeCamera camera, double factor) {
  camera.fx *= factor;
  camera.fy *= factor;
  const double squared = factor * factor;
  camera.distortion[0] *= squared;
  camera.distortion[1] *= squared * squared;
  camera.distortion[2] *= factor;
  camera.distortion[3] *= factor;
  camera.distortion[4] *= squared * squared * squared;
  return camera;
}

PinholeCamera pinhole_of(const PinholeCamera& given, const PinholeCamera& raw,
                         const PinholeCamera& used) {
  PinholeCamera pinhole = given;
  const double longer = used.focal_px() / raw.focal_px();
  const Eigen::Vector2d centre = given.project(CameraChange(used, raw)(Eigen::Vector2d::Zero()));
  pinhole.fx *= longer;
  pinhole.fy *= longer;
  pinhole.cx = centre.x();
  pinhole.cy = centre.y();
  return pinhole;
}

}  // namespace oneac
