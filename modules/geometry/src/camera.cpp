#include "oneac/geometry/camera.h"

#include "oneac/base/require.h"

#include <algorithm>
#include <cmath>

namespace oneac {

bool PinholeCamera::is_distorted() const {
  return lens != LensModel::plumb_bob ||
         std::any_of(distortion.begin(), distortion.end(), [](double k) { return k != 0.0; });
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

std::optional<PinholeCamera> resized(const PinholeCamera& camera, int width, int height) {
  if (camera.width <= 0 || camera.height <= 0 || width <= 0 || height <= 0) return std::nullopt;
  const double sx = static_cast<double>(width) / camera.width;
  const double sy = static_cast<double>(height) / camera.height;
  // A side is off by less than a pixel where it was rounded or cut to whole ones.
  const double off_px =
      std::min(std::abs(sx - sy) * camera.height, std::abs(sx - sy) * camera.width);
  if (off_px >= 1.0) return std::nullopt;
  PinholeCamera other = camera;
  other.width = width;
  other.height = height;
  other.fx *= sx;
  other.fy *= sy;
  other.cx = (camera.cx + 0.5) * sx - 0.5;  // the corner of the image stays its corner
  other.cy = (camera.cy + 0.5) * sy - 0.5;
  return other;
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
