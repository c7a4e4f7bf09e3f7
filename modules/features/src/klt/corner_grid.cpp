#include "corner_grid.h"

#include "patch/image_rows.h"

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

/// Smaller eigenvalue at each pixel of level 1, zero near the border.
class CornerResponse {
 public:
  explicit CornerResponse(const PyramidLevel& image)
      : width_(static_cast<std::size_t>(image.width)),
        values_(width_ * static_cast<std::size_t>(image.height), 0.0F) {
    // Products of the gradient summed over 7 rows. 12-bit grey: 49 products fit 32 bits.
    std::vector<std::int32_t> xx(width_), xy(width_), yy(width_);
    const GradientSums sums{xx.data(), xy.data(), yy.data()};
    const ImageRowKernels& kernels = simd_kernels<ImageRowKernels>();
    const auto add = [&](int v, std::int32_t sign) {
      kernels.add_gradients(image.row(v - 1), image.row(v), image.row(v + 1), width_, sign, sums);
    };
    for (int v = 0; v < image.height; ++v) {
      add(v, 1);
      if (v > 2 * kBox) add(v - 2 * kBox - 1, -1);
      if (v < 2 * kBox) continue;
      float* out = values_.data() + static_cast<std::size_t>(v - kBox) * width_;
      kernels.smaller_eigenvalues(sums, width_, out);
    }
  }

  [[nodiscard]] const float* row(int v) const {
    return values_.data() + static_cast<std::size_t>(v) * width_;
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
  const auto width = static_cast<std::size_t>(image.width);
  std::vector<std::int32_t> is_maximum(width);
  for (int v = kBorder; v < image.height - kBorder; ++v) {
    const float* row = response.row(v);
    simd_kernels<ImageRowKernels>().maxima(response.row(v - 1), row, response.row(v + 1), kBorder,
                                           width - kBorder, kLeast, is_maximum.data());
    for (int u = kBorder; u < image.width - kBorder; ++u) {
      if (is_maximum[static_cast<std::size_t>(u)] == 0) continue;
      const Corner corner{{2.0 * u, 2.0 * v}, row[u]};
      if (!usable(corner.u)) continue;
      const int index = (2 * v / cell_px) * grid.columns + 2 * u / cell_px;
      offer(grid.cells[static_cast<std::size_t>(index)], corner);
    }
  }
  return grid;
}

}  // namespace oneac::internal
