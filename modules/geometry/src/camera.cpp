#include "oneac/geometry/camera.h"

#include "oneac/base/require.h"

#include <algorithm>
#include <cmath>

namespace oneac {

bool PinholeCamera::is_distorted() const {
  return std::any_of(distortion.begin(), distortion.end(), [](double k) { return k != 0.0; });
}

double PinholeCamera::focal_px() const {
  return std::sqrt(fx * fy);
}

Eigen::Vector2d PinholeCamera::normalise(const Eigen::Vector2d& u) const {
  return {(u.x() - cx) / fx, (u.y() - cy) / fy};
}

Eigen::Vector2d PinholeCamera::project(const Eigen::Vector2d& x) const {
  return {fx * x.x() + cx, fy * x.y() + cy};
}

void PinholeCamera::validate() const {
  require(width > 0, "PinholeCamera.width", width, "positive");
  require(height > 0, "PinholeCamera.height", height, "positive");
  require(std::isfinite(fx) && fx > 0.0, "PinholeCamera.fx", fx, "positive and finite");
  require(std::isfinite(fy) && fy > 0.0, "PinholeCamera.fy", fy, "positive and finite");
  require(std::isfinite(cx), "PinholeCamera.cx", cx, "finite");
  require(std::isfinite(cy), "PinholeCamera.cy", cy, "finite");
  for (double k : distortion) require(std::isfinite(k), "PinholeCamera.distortion", k, "finite");
}

AffineCorrespondence normalise(const AffineCorrespondence& ac_px, const PinholeCamera& first,
                               const PinholeCamera& second) {
  AffineCorrespondence ac{first.normalise(ac_px.x1), second.normalise(ac_px.x2), ac_px.A};
  ac.A.row(0) /= second.fx;
  ac.A.row(1) /= second.fy;
  ac.A.col(0) *= first.fx;
  ac.A.col(1) *= first.fy;
  return ac;
}

}  // namespace oneac
