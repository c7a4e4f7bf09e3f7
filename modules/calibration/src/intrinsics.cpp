#include "oneac/calibration/intrinsics.h"

#include "oneac/geometry/lens.h"

#include <cmath>
#include <limits>

namespace oneac {

PinholeCamera changed(const PinholeCamera& camera, const IntrinsicsVector& change) {
  PinholeCamera result = camera;
  const double factor = std::exp(change[kFocal]);
  result.fx *= factor;
  result.fy *= factor;
  result.cx += change[kCentreX] * camera.focal_px();
  result.cy += change[kCentreY] * camera.focal_px();
  result.distortion[0] += change[kK1];
  result.distortion[1] += change[kK2];
  return result;
}

IntrinsicsVector change_between(const PinholeCamera& from, const PinholeCamera& to) {
  IntrinsicsVector change;
  change[kFocal] = std::log(to.focal_px() / from.focal_px());
  change[kCentreX] = (to.cx - from.cx) / from.focal_px();
  change[kCentreY] = (to.cy - from.cy) / from.focal_px();
  change[kK1] = to.distortion[0] - from.distortion[0];
  change[kK2] = to.distortion[1] - from.distortion[1];
  return change;
}

Eigen::Vector2d project_distorted(const PinholeCamera& camera, const Eigen::Vector2d& x) {
  return camera.project(distorted(camera, x));
}

Eigen::Vector2d normalise_distorted(const PinholeCamera& camera, const Eigen::Vector2d& u) {
  const auto x = undistorted(camera, camera.normalise(u));
  return x ? *x : Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace oneac
