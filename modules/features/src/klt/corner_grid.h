#pragma once

#include "patch/image_pyramid.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace oneac::internal {

struct Corner {
  Eigen::Vector2d u = Eigen::Vector2d::Zero();  ///< [px of level 0]
  float score = 0.0F;  ///< smaller eigenvalue of the structure tensor; any unit
};

/// The best corners of each cell of an image, best first.
struct CornerGrid {
  int columns = 0;
  int rows = 0;
  std::vector<std::vector<Corner>> cells;  ///< row by row

  /// Corners in all cells.
  [[nodiscard]] std::size_t size() const {
    std::size_t count = 0;
    for (const auto& cell : cells) count += cell.size();
    return count;
  }
};

/// Local maxima of the smaller eigenvalue (Shi and Tomasi) of gradients summed over 7×7 pixels of
/// level 1: texture in two directions on the scale of the windows that are aligned later.
/// @param usable  whether a pixel may be used, called with level-0 coordinates
[[nodiscard]] CornerGrid find_corners(const ImagePyramid& pyramid, int cell_px,
                                      const std::function<bool(const Eigen::Vector2d&)>& usable);

}  // namespace oneac::internal
