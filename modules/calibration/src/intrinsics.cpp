#include "oneac/calibration/intrinsics.h"

#include "distortion.h"

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
  double distorted[2];
  distort(camera.distortion.data(), x.x(), x.y(), distorted);
  return camera.project({distorted[0], distorted[1]});
}

Eigen::Vector2d normalise_distorted(const PinholeCamera& camera, const Eigen::Vector2d& u) {
  constexpr int kIterations = 50;
  constexpr double kTolerance = 1e-10;
  const Eigen::Vector2d wanted = camera.normalise(u);
  Eigen::Vector2d x = wanted;
  for (int i = 0; i < kIterations && x.allFinite(); ++i) {
    double distorted[2];
    distort(camera.distortion.data(), x.x(), x.y(), distorted);
    const Eigen::Vector2d missing = wanted - Eigen::Vector2d(distorted[0], distorted[1]);
    if (missing.norm() < kTolerance) return x;
    x += missing;
  }
  return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace oneac
