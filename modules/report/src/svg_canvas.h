#pragma once

#include "oneac/report/plot.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>

namespace oneac::internal {

/// A coordinate on the page: a tenth of a pixel is enough.
[[nodiscard]] std::string place(double value);
/// Classes of a series' colour, dashes and number.
[[nodiscard]] std::string series_class(std::size_t number);
/// @param anchor  "start", "middle" or "end"
[[nodiscard]] std::string svg_text(double u, double v, const std::string& text, const char* anchor,
                                   const char* style = "");

/// Layout of a figure [px].
inline constexpr double kWidth = 540.0, kPlanHeight = 540.0;
inline constexpr double kLeft = 64.0, kRight = 14.0, kBottom = 44.0;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] bool empty() const { return !(low <= high); }
  [[nodiscard]] double size() const { return high - low; }
};

/// Room around the values; a constant gets some above and below.
[[nodiscard]] Range padded(Range range);

/// From values to places on the page.
struct Canvas {
  Range x, y;
  double top = 0.0, height = 0.0;

  [[nodiscard]] double bottom() const { return height - kBottom; }
  [[nodiscard]] double u(double value) const {
    return kLeft + (value - x.low) / x.size() * (kWidth - kLeft - kRight);
  }
  [[nodiscard]] double v(double value) const {
    return bottom() - (value - y.low) / y.size() * (bottom() - top);
  }
};

/// Grid and axes with their numbers.
[[nodiscard]] std::string grid_svg(const Canvas& canvas, Axes axes);
/// "20 m": what a square of a plan's grid is.
[[nodiscard]] std::string grid_size(const Canvas& canvas, const std::string& unit);

/// A dot, a ring or the marker of the series' number.
[[nodiscard]] std::string mark_svg(Pen pen, double u, double v, std::size_t number);

/// The labels in rows between title and plot, and where the plot starts below them.
struct Legend {
  std::string svg;
  double bottom = 0.0;  ///< [px]
};
[[nodiscard]] Legend legend_of(const Plot& plot);

}  // namespace oneac::internal
