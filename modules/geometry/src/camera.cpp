#include "oneac/geometry/camera.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

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
  const auto require = [](bool good, const std::string& field, double value, const char* bound) {
    if (good) return;
    throw std::invalid_argument("PinholeCamera." + field + " = " + std::to_string(value) +
                                ", must be " + bound);
  };
  require(width > 0, "width", width, "positive");
  require(height > 0, "height", height, "positive");
  require(std::isfinite(fx) && fx > 0.0, "fx", fx, "positive and finite");
  require(std::isfinite(fy) && fy > 0.0, "fy", fy, "positive and finite");
  require(std::isfinite(cx), "cx", cx, "finite");
  require(std::isfinite(cy), "cy", cy, "finite");
  for (double k : distortion) require(std::isfinite(k), "distortion", k, "finite");
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
