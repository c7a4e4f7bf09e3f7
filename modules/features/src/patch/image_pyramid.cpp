#include "image_pyramid.h"

#include "image_rows.h"

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
  const ImageRowKernels& kernels = simd_kernels<ImageRowKernels>();
  std::vector<std::uint16_t> column_sums(width + 2);
  for (int v = 0; v < image.height; ++v) {
    const auto source = [&image](int row) {
      return image.data +
             static_cast<std::ptrdiff_t>(std::clamp(row, 0, image.height - 1)) * image.stride;
    };
    const std::uint8_t *above = source(v - 1), *here = source(v), *below = source(v + 1);
    std::uint16_t* sums = column_sums.data() + 1;
    kernels.sum_of_three(above, here, below, width, sums);
    sums[-1] = sums[0];
    sums[width] = sums[width - 1];
    kernels.smooth_along(column_sums.data(), width, level.row(v));
  }
  repeat_border(level);
  return level;
}

/// (1 4 6 4 1) / 16 in both directions at every second pixel.
PyramidLevel halve(const PyramidLevel& fine) {
  PyramidLevel level = allocate((fine.width + 1) / 2, (fine.height + 1) / 2);
  const auto width = static_cast<std::size_t>(level.width);
  const std::size_t needed = 2 * width + 4;
  const ImageRowKernels& kernels = simd_kernels<ImageRowKernels>();
  std::vector<std::uint16_t> column_sums(needed);
  for (int v = 0; v < level.height; ++v) {
    const std::uint16_t* rows[5];
    for (int i = 0; i < 5; ++i) rows[i] = fine.row(2 * v - 2 + i) - 2;
    kernels.sum_of_five(rows, needed, column_sums.data());
    kernels.halve_along(column_sums.data(), width, level.row(v));
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
