#pragma once

#include "oneac/geometry/camera.h"

#include <cmath>

namespace oneac {

/// distorted() for any scalar, as the derivatives of an optimiser are.
/// @param k  eight coefficients, as PinholeCamera has them
template <typename Scalar>
void distort(LensModel lens, const Scalar* k, const Scalar& x, const Scalar& y, Scalar* distorted) {
  using std::atan;
  using std::sqrt;
  const Scalar r2 = x * x + y * y;
  if (lens == LensModel::kannala_brandt) {
    // θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸), along the direction from the axis
    const bool on_axis = !(r2 > 1e-30);
    const Scalar r = on_axis ? Scalar(1.0) : Scalar(sqrt(r2));
    const Scalar angle = atan(r), a2 = angle * angle;
    const Scalar stretched = angle * (1.0 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))));
    const Scalar scale = on_axis ? Scalar(1.0) : Scalar(stretched / r);
    distorted[0] = x * scale;
    distorted[1] = y * scale;
    return;
  }
  const Scalar xy = x * y;
  const Scalar radial =
      (1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) / (1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
  distorted[0] = x * radial + 2.0 * k[2] * xy + k[3] * (r2 + 2.0 * x * x);
  distorted[1] = y * radial + k[2] * (r2 + 2.0 * y * y) + 2.0 * k[3] * xy;
}

}  // namespace oneac
