#include "corner_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace oneac::internal {
namespace {

constexpr int kBox = 3;              // [px of level 1] half of the 7×7 sum
constexpr int kBorder = 6;           // [px of level 1] the smallest window must lie inside
constexpr std::size_t kPerCell = 6;  // reserve for cells whose neighbours are empty
// [grey per px of level 1] a mean square gradient below JPEG noise of about one grey level.
constexpr float kLeastGradient = 1.0F;
constexpr float kGrey = PyramidLevel::kPerGrey;

/// Products of the gradient summed over 7 rows, one entry per column.
struct ColumnSums {
  explicit ColumnSums(std::size_t width) : xx(width), xy(width), yy(width) {}
  std::vector<std::int32_t> xx, xy, yy;

  /// Adds (sign 1) or takes away (sign −1) one row. 12-bit grey: 49 products fit 32 bits.
  void add(const PyramidLevel& image, int v, std::int32_t sign) {
    const std::uint16_t* here = image.row(v);
    const std::uint16_t *above = image.row(v - 1), *below = image.row(v + 1);
    std::int32_t *x = xx.data(), *m = xy.data(), *y = yy.data();
    const auto width = static_cast<std::ptrdiff_t>(xx.size());
    for (std::ptrdiff_t u = 0; u < width; ++u) {
      const auto gx = static_cast<std::int16_t>(here[u + 1] - here[u - 1]);
      const auto gy = static_cast<std::int16_t>(below[u] - above[u]);
      x[u] += sign * (gx * gx);
      m[u] += sign * (gx * gy);
      y[u] += sign * (gy * gy);
    }
  }
};

/// Sums of 7 neighbours, for u in [kBox, width − kBox).
void box_sums(const std::vector<std::int32_t>& in, std::vector<float>& out) {
  const std::size_t count = in.size() - 2 * std::size_t{kBox};
  const std::int32_t* p = in.data();
  float* sums = out.data() + kBox;
  for (std::size_t u = 0; u < count; ++u) {
    sums[u] =
        static_cast<float>(p[u] + p[u + 1] + p[u + 2] + p[u + 3] + p[u + 4] + p[u + 5] + p[u + 6]);
  }
}

/// Smaller eigenvalue at each pixel of level 1, zero near the border.
class CornerResponse {
 public:
  explicit CornerResponse(const PyramidLevel& image)
      : width_(static_cast<std::size_t>(image.width)),
        values_(width_ * static_cast<std::size_t>(image.height), 0.0F) {
    ColumnSums sums(width_);
    std::vector<float> xx(width_), xy(width_), yy(width_);
    for (int v = 0; v < image.height; ++v) {
      sums.add(image, v, 1);
      if (v > 2 * kBox) sums.add(image, v - 2 * kBox - 1, -1);
      if (v < 2 * kBox) continue;
      box_sums(sums.xx, xx);
      box_sums(sums.xy, xy);
      box_sums(sums.yy, yy);
      float* out = values_.data() + static_cast<std::size_t>(v - kBox) * width_;
      for (std::size_t u = kBox; u < width_ - kBox; ++u) {
        const float difference = xx[u] - yy[u];
        out[u] = 0.5F * (xx[u] + yy[u] - std::sqrt(difference * difference + 4.0F * xy[u] * xy[u]));
      }
    }
  }

  [[nodiscard]] const float* row(int v) const {
    return values_.data() + static_cast<std::size_t>(v) * width_;
  }
  [[nodiscard]] bool is_maximum(int u, int v) const {
    const float *above = row(v - 1) + u, *here = row(v) + u, *below = row(v + 1) + u;
    const float value = *here;
    // Strict on one side, so that of two equal neighbours one stays.
    return value > here[-1] && value >= here[1] && value > above[-1] && value > above[0] &&
           value > above[1] && value >= below[-1] && value >= below[0] && value >= below[1];
  }

 private:
  std::size_t width_;
  std::vector<float> values_;
};

void offer(std::vector<Corner>& cell, const Corner& corner) {
  const auto place = std::find_if(cell.begin(), cell.end(),
                                  [&](const Corner& c) { return c.score < corner.score; });
  if (place == cell.end() && cell.size() >= kPerCell) return;
  cell.insert(place, corner);
  if (cell.size() > kPerCell) cell.pop_back();
}

}  // namespace

CornerGrid find_corners(const ImagePyramid& pyramid, int cell_px,
                        const std::function<bool(const Eigen::Vector2d&)>& usable) {
  CornerGrid grid;
  grid.columns = (pyramid.width() + cell_px - 1) / cell_px;
  grid.rows = (pyramid.height() + cell_px - 1) / cell_px;
  grid.cells.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
  if (pyramid.levels.size() < 2) return grid;
  const PyramidLevel& image = pyramid.levels[1];
  if (std::min(image.width, image.height) <= 2 * kBorder) return grid;
  const CornerResponse response(image);
  // Central differences are twice the gradient.
  constexpr float kLeast = 49.0F * 4.0F * kLeastGradient * kLeastGradient * kGrey * kGrey;
  for (int v = kBorder; v < image.height - kBorder; ++v) {
    const float* row = response.row(v);
    for (int u = kBorder; u < image.width - kBorder; ++u) {
      if (row[u] < kLeast || !response.is_maximum(u, v)) continue;
      const Corner corner{{2.0 * u, 2.0 * v}, row[u]};
      if (!usable(corner.u)) continue;
      const int index = (2 * v / cell_px) * grid.columns + 2 * u / cell_px;
      offer(grid.cells[static_cast<std::size_t>(index)], corner);
    }
  }
  return grid;
}

}  // namespace oneac::internal
