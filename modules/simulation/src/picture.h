#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace oneac::simulation {

/// Grey levels of a picture in rows; reading beyond its borders gives what is at the border.
struct Picture {
  std::vector<float>& grey;
  int width;
  int height;

  [[nodiscard]] float& at(int u, int v) const {
    return grey[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(u)];
  }
  [[nodiscard]] float near(double u, double v) const {
    const int column = static_cast<int>(std::clamp(u + 0.5, 0.0, width - 1.0));
    const int row = static_cast<int>(std::clamp(v + 0.5, 0.0, height - 1.0));
    return at(column, row);
  }
};

}  // namespace oneac::simulation
