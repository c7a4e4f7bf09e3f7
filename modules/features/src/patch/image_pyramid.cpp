#include "image_pyramid.h"

#include <algorithm>

namespace oneac::internal {
namespace {

constexpr int kSmallestSide = 20;  // [px] a coarser level would be smaller than its window

PyramidLevel allocate(int width, int height) {
  PyramidLevel level;
  level.width = width;
  level.height = height;
  level.stride = width + 2 * PyramidLevel::kBorder;
  level.pixels.resize(static_cast<std::size_t>(level.stride) *
                      static_cast<std::size_t>(height + 2 * PyramidLevel::kBorder));
  return level;
}

void repeat_border(PyramidLevel& level) {
  constexpr int kBorder = PyramidLevel::kBorder;
  for (int v = 0; v < level.height; ++v) {
    std::uint16_t* row = level.row(v);
    std::fill(row - kBorder, row, row[0]);
    std::fill(row + level.width, row + level.width + kBorder, row[level.width - 1]);
  }
  const auto copy_row = [&level](int from, int to) {
    const std::uint16_t* source = level.row(from) - kBorder;
    std::copy(source, source + level.stride, level.row(to) - kBorder);
  };
  for (int i = 1; i <= kBorder; ++i) {
    copy_row(0, -i);
    copy_row(level.height - 1, level.height - 1 + i);
  }
}

PyramidLevel smooth(const ImageView& image) {
  PyramidLevel level = allocate(image.width, image.height);
  const auto width = static_cast<std::size_t>(image.width);
  std::vector<std::uint16_t> column_sums(width + 2);
  for (int v = 0; v < image.height; ++v) {
    const auto source = [&image](int row) {
      return image.data +
             static_cast<std::ptrdiff_t>(std::clamp(row, 0, image.height - 1)) * image.stride;
    };
    const std::uint8_t *above = source(v - 1), *here = source(v), *below = source(v + 1);
    std::uint16_t* sums = column_sums.data() + 1;
    for (std::size_t u = 0; u < width; ++u) {
      sums[u] = static_cast<std::uint16_t>(above[u] + 2 * here[u] + below[u]);
    }
    sums[-1] = sums[0];
    sums[width] = sums[width - 1];
    std::uint16_t* out = level.row(v);
    const std::uint16_t* left = column_sums.data();
    for (std::size_t u = 0; u < width; ++u) {
      out[u] = static_cast<std::uint16_t>(left[u] + 2 * left[u + 1] + left[u + 2]);
    }
  }
  repeat_border(level);
  return level;
}

/// (1 4 6 4 1) / 16 in both directions at every second pixel.
PyramidLevel halve(const PyramidLevel& fine) {
  PyramidLevel level = allocate((fine.width + 1) / 2, (fine.height + 1) / 2);
  const auto width = static_cast<std::size_t>(level.width);
  const std::size_t needed = 2 * width + 4;
  std::vector<std::uint16_t> column_sums(needed);
  for (int v = 0; v < level.height; ++v) {
    const std::uint16_t* rows[5];
    for (int i = 0; i < 5; ++i) rows[i] = fine.row(2 * v - 2 + i) - 2;
    for (std::size_t u = 0; u < needed; ++u) {
      const int sum = rows[0][u] + rows[4][u] + 4 * (rows[1][u] + rows[3][u]) + 6 * rows[2][u];
      column_sums[u] = static_cast<std::uint16_t>((sum + 8) >> 4);
    }
    std::uint16_t* out = level.row(v);
    const std::uint16_t* s = column_sums.data();
    for (std::size_t u = 0; u < width; ++u) {
      const std::uint16_t* c = s + 2 * u;
      out[u] = static_cast<std::uint16_t>((c[0] + c[4] + 4 * (c[1] + c[3]) + 6 * c[2] + 8) >> 4);
    }
  }
  repeat_border(level);
  return level;
}

}  // namespace

ImagePyramid build_pyramid(const ImageView& image, int levels) {
  ImagePyramid pyramid;
  pyramid.levels.reserve(static_cast<std::size_t>(levels));
  pyramid.levels.push_back(smooth(image));
  while (static_cast<int>(pyramid.levels.size()) < levels) {
    const PyramidLevel& last = pyramid.levels.back();
    if (std::min(last.width, last.height) < 2 * kSmallestSide) break;
    pyramid.levels.push_back(halve(last));
  }
  return pyramid;
}

}  // namespace oneac::internal
