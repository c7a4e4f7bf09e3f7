#include "static_structure.h"

#include <algorithm>
#include <cmath>

namespace oneac::internal {
namespace {

constexpr int kMemory = 30;       // [frames] that a mean reaches back: one or two seconds
constexpr int kLeastFrames = 12;  // passing structure keeps a twelfth then
constexpr float kRadial = 0.25F;  // least cos² between gradient and flow
// Mean (g·r)² of a cell [grey²/px²]: an edge of 8 grey levels across it. JPEG blocks stay below 1.
constexpr float kStructure = 4.0F;
constexpr float kRestsShare = 0.6F;   // of (g·r)² in the mean: a sway of the car costs a third
constexpr float kMovesShare = 0.25F;  // passing structure keeps a tenth, twice that by chance
constexpr int kBorder = 2;            // [px] rectified images end in an edge of their own

}  // namespace

void StaticStructure::add(const PyramidLevel& level, const Eigen::Vector2d& foe, int first_row) {
  if (width_ != level.width || height_ != level.height) {
    clear();
    width_ = level.width;
    height_ = level.height;
    means_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  }
  frames_ = std::min(frames_ + 1, kMemory);
  const float share = 1.0F / static_cast<float>(frames_);
  const auto fx = static_cast<float>(foe.x()), fy = static_cast<float>(foe.y());
  for (int v = std::max(kBorder, first_row); v < height_ - kBorder; ++v) {
    const std::uint16_t *above = level.row(v - 1), *here = level.row(v), *below = level.row(v + 1);
    Mean* mean = means_.data() + static_cast<std::ptrdiff_t>(v) * width_;
    const float y = static_cast<float>(v) - fy;
    for (int u = kBorder; u < width_ - kBorder; ++u) {
      const float gx =
          0.5F * PyramidLevel::kGreyPerUnit * static_cast<float>(here[u + 1] - here[u - 1]);
      const float gy = 0.5F * PyramidLevel::kGreyPerUnit * static_cast<float>(below[u] - above[u]);
      const float x = static_cast<float>(u) - fx;
      const float away = x * x + y * y + 1.0F;
      const float dot = gx * x + gy * y;
      const bool radial = dot * dot >= kRadial * (gx * gx + gy * gy) * away;
      const float gg = radial ? dot * dot / away : 0.0F;
      const float g = std::copysign(std::sqrt(gg), dot);
      mean[u].g += share * (g - mean[u].g);
      mean[u].gg += share * (gg - mean[u].gg);
    }
  }
}

bool StaticStructure::can_tell() const {
  return frames_ >= kLeastFrames;
}

std::vector<CellTrace> StaticStructure::traces(const CellGrid& grid) const {
  std::vector<CellTrace> traces(grid.size(), CellTrace::kNothing);
  if (!can_tell()) return traces;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      traces[grid.at(column, row)] = trace(grid, column, row);
    }
  }
  return traces;
}

CellTrace StaticStructure::trace(const CellGrid& grid, int column, int row) const {
  const int left = column * grid.side, top = row * grid.side;
  const int right = std::min(left + grid.side, width_), bottom = std::min(top + grid.side, height_);
  float kept = 0.0F, all = 0.0F;
  for (int v = top; v < bottom; ++v) {
    const Mean* mean = means_.data() + static_cast<std::ptrdiff_t>(v) * width_;
    for (int u = left; u < right; ++u) {
      kept += mean[u].g * mean[u].g;
      all += mean[u].gg;
    }
  }
  const auto pixels = static_cast<float>((right - left) * (bottom - top));
  if (!(all >= kStructure * pixels)) return CellTrace::kNothing;
  if (kept >= kRestsShare * all) return CellTrace::kRests;
  return kept < kMovesShare * all ? CellTrace::kMoves : CellTrace::kNothing;
}

void StaticStructure::clear() {
  frames_ = 0;
  means_.assign(means_.size(), Mean{});
}

}  // namespace oneac::internal
