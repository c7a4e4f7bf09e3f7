#include "patch_window.h"

#include <cmath>

namespace oneac::internal {
namespace {

// Keeps positions inside the window positive: more than the reach of any window.
constexpr int kOffset = 64;
constexpr double kMaxReach = 60.0;  // [px]

}  // namespace

PatchWindow round_window(double radius, int row_step) {
  PatchWindow window;
  window.radius = static_cast<float>(radius);
  window.row_step = static_cast<std::size_t>(row_step);
  const int reach = static_cast<int>(std::floor(radius));
  for (int y = -reach; y <= reach; y += row_step) {
    const std::size_t before = window.size;
    const int half = static_cast<int>(std::floor(std::sqrt(radius * radius - y * y)));
    for (int x = -half; x <= half; ++x) {
      const double share = (x * x + y * y) / (radius * radius);
      window.x[window.size] = static_cast<float>(x);
      window.y[window.size] = static_cast<float>(y);
      window.weight[window.size] = static_cast<float>(1.0 - 0.5 * share);
      window.weight_sum += window.weight[window.size];
      ++window.size;
    }
    window.row_begin[window.rows] = static_cast<std::size_t>(reach + 1 - half);
    window.row_size[window.rows++] = window.size - before;
  }
  while (window.size % kPatchLanes != 0) {
    window.x[window.size] = window.y[window.size] = window.weight[window.size] = 0.0F;
    ++window.size;
  }
  return window;
}

PatchWindow padded_window(double radius) {
  PatchWindow window;
  window.radius = static_cast<float>(radius);
  const int reach = static_cast<int>(std::floor(radius));
  const auto side = 2 * static_cast<std::size_t>(reach) + 1;
  const std::size_t width = (side + kPatchLanes - 1) / kPatchLanes * kPatchLanes;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x < static_cast<int>(width) - reach; ++x) {
      const double share = (x * x + y * y) / (radius * radius);
      const float weight = share <= 1.0 ? static_cast<float>(1.0 - 0.5 * share) : 0.0F;
      window.x[window.size] = static_cast<float>(x);
      window.y[window.size] = static_cast<float>(y);
      window.weight[window.size++] = weight;
      window.weight_sum += weight;
    }
    window.row_begin[window.rows] = 1;
    window.row_size[window.rows++] = width;
  }
  return window;
}

std::optional<SampleGrid> place(const ImagePyramid& pyramid, std::size_t level,
                                const PatchWarp& warp, double radius, double margin) {
  const PyramidLevel& image = pyramid.levels[level];
  const double scale = 1.0 / level_scale(level);
  const Eigen::Vector2d centre = warp.centre * scale;
  const Eigen::Vector2d reach = radius * warp.M.rowwise().norm();
  if (!(reach.maxCoeff() < kMaxReach)) return std::nullopt;
  const Eigen::Vector2d low = centre - reach, high = centre + reach;
  if (!(low.minCoeff() >= -margin && high.x() <= image.width - 1 + margin &&
        high.y() <= image.height - 1 + margin)) {
    return std::nullopt;
  }
  const int u = static_cast<int>(std::floor(centre.x())),
            v = static_cast<int>(std::floor(centre.y()));
  SampleGrid grid;
  grid.data = image.pixels.data();
  grid.stride = image.stride;
  grid.origin = image.index(u - kOffset, v - kOffset);
  grid.a11 = static_cast<float>(warp.M(0, 0));
  grid.a12 = static_cast<float>(warp.M(0, 1));
  grid.a21 = static_cast<float>(warp.M(1, 0));
  grid.a22 = static_cast<float>(warp.M(1, 1));
  grid.u = static_cast<float>(centre.x() - u + kOffset);
  grid.v = static_cast<float>(centre.y() - v + kOffset);
  return grid;
}

}  // namespace oneac::internal
