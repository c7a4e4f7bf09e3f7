#pragma once

namespace oneac {

/// OpenCV's plumb-bob model, for doubles and Ceres' Jets. @param k  k1, k2, p1, p2, k3
template <typename Scalar, typename Coefficient>
void distort(const Coefficient* k, const Scalar& x, const Scalar& y, Scalar* distorted) {
  const Scalar r2 = x * x + y * y;
  const Scalar radial = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  distorted[0] = x * radial + 2.0 * k[2] * x * y + k[3] * (r2 + 2.0 * x * x);
  distorted[1] = y * radial + k[2] * (r2 + 2.0 * y * y) + 2.0 * k[3] * x * y;
}

}  // namespace oneac
