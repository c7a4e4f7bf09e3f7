#include "oneac/geometry/lens.h"

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

// θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸), along the direction from the axis
Eigen::Vector2d fisheye(const PinholeCamera& camera, const Eigen::Vector2d& x) {
  const auto& k = camera.distortion;
  const double r = x.norm();
  if (!(r > 0.0)) return x;
  const double angle = std::atan(r), a2 = angle * angle;
  const double stretched = angle * (1.0 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))));
  return x * (stretched / r);
}

Eigen::Vector2d polynomial(const PinholeCamera& camera, const Eigen::Vector2d& x) {
  const auto& [k1, k2, p1, p2, k3, k4, k5, k6] = camera.distortion;
  const double r2 = x.squaredNorm(), xy = x.x() * x.y();
  const double radial =
      (1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1.0 + r2 * (k4 + r2 * (k5 + r2 * k6)));
  return {x.x() * radial + 2.0 * p1 * xy + p2 * (r2 + 2.0 * x.x() * x.x()),
          x.y() * radial + p1 * (r2 + 2.0 * x.y() * x.y()) + 2.0 * p2 * xy};
}

}  // namespace

Eigen::Vector2d distorted(const PinholeCamera& camera, const Eigen::Vector2d& x) {
  return camera.lens == LensModel::kannala_brandt ? fisheye(camera, x) : polynomial(camera, x);
}

bool is_five_term_lens(const PinholeCamera& camera) {
  constexpr std::ptrdiff_t kFive = 5;
  return camera.lens == LensModel::plumb_bob &&
         std::all_of(camera.distortion.begin() + kFive, camera.distortion.end(),
                     [](double k) { return k == 0.0; });
}

}  // namespace oneac
