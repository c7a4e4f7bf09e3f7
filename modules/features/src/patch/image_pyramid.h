#pragma once

#include "oneac/base/image.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oneac::internal {

/// One smoothed image of a pyramid, in sixteenths of a grey level, with its border repeated
/// outwards.
struct PyramidLevel {
  static constexpr int kBorder = 24;   ///< [px] room for a window whose centre is on the border
  static constexpr int kPerGrey = 16;  ///< units of a pixel in one grey level
  static constexpr float kGreyPerUnit = 1.0F / kPerGrey;  ///< grey levels in a unit

  int width = 0;
  int height = 0;
  int stride = 0;
  std::vector<std::uint16_t> pixels;

  [[nodiscard]] int index(int u, int v) const { return (v + kBorder) * stride + u + kBorder; }
  [[nodiscard]] const std::uint16_t* row(int v) const { return pixels.data() + index(0, v); }
  [[nodiscard]] std::uint16_t* row(int v) { return pixels.data() + index(0, v); }
};

/// Level l shows pixel u of the image at u / 2^l. Level 0 is the image smoothed by the binomial
/// 3×3 kernel (σ = 0.7 px), which takes the edge off JPEG blocks and bilinear interpolation.
struct ImagePyramid {
  std::vector<PyramidLevel> levels;

  [[nodiscard]] int width() const { return levels.front().width; }
  [[nodiscard]] int height() const { return levels.front().height; }
};

/// At most `levels` levels, fewer when the image is too small for them. @pre not empty
[[nodiscard]] ImagePyramid build_pyramid(const ImageView& image, int levels);

}  // namespace oneac::internal
