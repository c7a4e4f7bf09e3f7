#pragma once

#include "image_rows.h"

#include "oneac/base/simd_lanes.h"

// The kernels of image_rows.h: plain loops, which the compiler fits to the registers.
namespace oneac::internal {
namespace {

inline void sum_of_three(const std::uint8_t* above, const std::uint8_t* here,
                         const std::uint8_t* below, std::size_t width,
                         std::uint16_t* __restrict sums) {
  for (std::size_t u = 0; u < width; ++u) {
    sums[u] = static_cast<std::uint16_t>(above[u] + 2 * here[u] + below[u]);
  }
}

inline void smooth_along(const std::uint16_t* sums, std::size_t width,
                         std::uint16_t* __restrict out) {
  for (std::size_t u = 0; u < width; ++u) {
    out[u] = static_cast<std::uint16_t>(sums[u] + 2 * sums[u + 1] + sums[u + 2]);
  }
}

// 16 × 12 bits: the sums fit 16 bits without a sign.
inline void sum_of_five(const std::uint16_t* const (&rows)[5], std::size_t width,
                        std::uint16_t* __restrict sums) {
  const std::uint16_t *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3], *e = rows[4];
  for (std::size_t u = 0; u < width; ++u) {
    const auto sum = static_cast<std::uint16_t>(a[u] + e[u] + 4 * (b[u] + d[u]) + 6 * c[u] + 8);
    sums[u] = static_cast<std::uint16_t>(sum >> 4);
  }
}

inline void halve_along(const std::uint16_t* sums, std::size_t width,
                        std::uint16_t* __restrict out) {
  for (std::size_t u = 0; u < width; ++u) {
    const std::uint16_t* c = sums + 2 * u;
    const auto sum = static_cast<std::uint16_t>(c[0] + c[4] + 4 * (c[1] + c[3]) + 6 * c[2] + 8);
    out[u] = static_cast<std::uint16_t>(sum >> 4);
  }
}

inline void add_gradients(const std::uint16_t* above, const std::uint16_t* here,
                          const std::uint16_t* below, std::size_t width, std::int32_t sign,
                          const GradientSums& sums) {
  std::int32_t* __restrict xx = sums.xx, * __restrict xy = sums.xy, * __restrict yy = sums.yy;
  for (std::size_t u = 0; u < width; ++u) {
    const auto gx = static_cast<std::int16_t>(here[u + 1] - (here - 1)[u]);
    const auto gy = static_cast<std::int16_t>(below[u] - above[u]);
    xx[u] += sign * (gx * gx);
    xy[u] += sign * (gx * gy);
    yy[u] += sign * (gy * gy);
  }
}

inline float sum_of_seven(const std::int32_t* p) {
  return static_cast<float>(p[0] + p[1] + p[2] + p[3] + p[4] + p[5] + p[6]);
}

inline void smaller_eigenvalues(const GradientSums& sums, std::size_t width,
                                float* __restrict out) {
  const std::int32_t *xx = sums.xx, *xy = sums.xy, *yy = sums.yy;
  const std::size_t count = width - 6;
  for (std::size_t u = 0; u < count; ++u) {
    const float a = sum_of_seven(xx + u), b = sum_of_seven(xy + u), c = sum_of_seven(yy + u);
    const float difference = a - c;
    out[u + 3] = 0.5F * (a + c - __builtin_sqrtf(difference * difference + 4.0F * b * b));
  }
}

inline void maxima(const float* above, const float* here, const float* below, std::size_t begin,
                   std::size_t end, float least, std::int32_t* __restrict flags) {
  for (std::size_t u = begin; u < end; ++u) {
    const float value = here[u];
    // Strict on one side, so that of two equal neighbours one stays.
    const bool before = (value > here[u - 1]) & (value > above[u - 1]) & (value > above[u]) &
                        (value > above[u + 1]);
    const bool after = (value >= here[u + 1]) & (value >= below[u - 1]) & (value >= below[u]) &
                       (value >= below[u + 1]);
    flags[u] = static_cast<std::int32_t>((value >= least) & before & after);
  }
}

constexpr ImageRowKernels kImageRowKernels{&sum_of_three, &smooth_along,  &sum_of_five,
                                           &halve_along,  &add_gradients, &smaller_eigenvalues,
                                           &maxima};

}  // namespace

template <>
const ImageRowKernels& simd_kernels_at<ImageRowKernels, kSimdLevel>() {
  return kImageRowKernels;
}

}  // namespace oneac::internal
