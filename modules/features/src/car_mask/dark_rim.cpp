#include "dark_rim.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace oneac::internal {
namespace {

// [frames] A street at night has shown most of its sky in two seconds.
constexpr int kKnown = 50, kEvery = 5;
// Black of a video is 16 grey levels; noise of 16 pixels together is a level or two.
constexpr int kDark = 20 * PyramidLevel::kPerGrey, kSame = 4 * PyramidLevel::kPerGrey;
// [px of a quarter of the image] As far as corners keep from a border, and what smoothing mixes.
constexpr int kReach = 3 + 2;

std::size_t index_of(int u, int v, int width) {
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(u);
}

/// What of `free` is joined to the border of the image.
std::vector<bool> joined_to_border(const std::vector<bool>& free, int width, int height) {
  std::vector<bool> joined(free.size(), false);
  std::vector<std::pair<int, int>> open;
  const auto visit = [&](int u, int v) {
    if (u < 0 || v < 0 || u >= width || v >= height) return;
    const std::size_t i = index_of(u, v, width);
    if (!free[i] || joined[i]) return;
    joined[i] = true;
    open.emplace_back(u, v);
  };
  for (int u = 0; u < width; ++u) {
    visit(u, 0);
    visit(u, height - 1);
  }
  for (int v = 0; v < height; ++v) {
    visit(0, v);
    visit(width - 1, v);
  }
  while (!open.empty()) {
    const auto [u, v] = open.back();
    open.pop_back();
    visit(u - 1, v);
    visit(u + 1, v);
    visit(u, v - 1);
    visit(u, v + 1);
  }
  return joined;
}

/// The same with kReach more on both sides, along rows or columns.
std::vector<bool> widened(const std::vector<bool>& region, int width, int height, bool along_rows) {
  std::vector<bool> wide(region.size(), false);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (!region[index_of(u, v, width)]) continue;
      for (int off = -kReach; off <= kReach; ++off) {
        const int x = along_rows ? u + off : u, y = along_rows ? v : v + off;
        if (x < 0 || y < 0 || x >= width || y >= height) continue;
        wide[index_of(x, y, width)] = true;
      }
    }
  }
  return wide;
}

}  // namespace

bool DarkRim::add(const PyramidLevel& level) {
  if (over_) return false;
  if (darkest_.empty()) {
    width_ = level.width;
    height_ = level.height;
    const std::size_t size = index_of(0, height_, width_);
    darkest_.assign(size, UINT16_MAX);
    brightest_.assign(size, 0);
  }
  std::size_t i = 0;
  for (int v = 0; v < height_; ++v) {
    const std::uint16_t* row = level.row(v);
    for (int u = 0; u < width_; ++u, ++i) {
      darkest_[i] = std::min(darkest_[i], row[u]);
      brightest_[i] = std::max(brightest_[i], row[u]);
    }
  }
  if (++frames_ < kKnown || frames_ % kEvery != 0) return false;
  decide();
  return true;
}

bool DarkRim::is_constant(std::size_t i) const {
  return brightest_[i] < kDark && brightest_[i] - darkest_[i] <= kSame;
}

void DarkRim::decide() {
  std::vector<bool> constant(darkest_.size());
  for (std::size_t i = 0; i < constant.size(); ++i) constant[i] = is_constant(i);
  const std::vector<bool> black = joined_to_border(constant, width_, height_);
  any_ = std::find(black.begin(), black.end(), true) != black.end();
  over_ = !any_;
  rim_ = widened(widened(black, width_, height_, true), width_, height_, false);
}

bool DarkRim::covers(const Eigen::Vector2d& u) const {
  if (!any_) return false;
  const int column = std::clamp(static_cast<int>(std::lround(u.x())), 0, width_ - 1);
  const int row = std::clamp(static_cast<int>(std::lround(u.y())), 0, height_ - 1);
  return rim_[index_of(column, row, width_)];
}

}  // namespace oneac::internal
