#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace oneac::internal {

/// A coordinate on the page: a tenth of a pixel is enough.
[[nodiscard]] std::string place(double value);
/// `class` of a colour, "c0" … "c5".
[[nodiscard]] std::string colour_class(std::size_t number);
[[nodiscard]] std::string svg_line(const char* style, double u1, double v1, double u2, double v2);
/// @param anchor  "start", "middle" or "end"
[[nodiscard]] std::string svg_text(double u, double v, const std::string& text, const char* anchor,
                                   const char* style = "");
/// Distance of ticks that gives about `count` of them over `range` > 0: 1, 2 or 5 times a power of
/// ten.
[[nodiscard]] double nice_step(double range, int count);
/// A multiple of the step with as many decimals as it needs.
[[nodiscard]] std::string tick_label(double value, double step);

/// Layout of a figure [px].
inline constexpr double kWidth = 540.0, kPlotHeight = 300.0, kPlanHeight = 540.0;
inline constexpr double kLeft = 58.0, kRight = 14.0, kTop = 54.0, kBottom = 44.0;

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
  double height = kPlotHeight;

  [[nodiscard]] double u(double value) const {
    return kLeft + (value - x.low) / x.size() * (kWidth - kLeft - kRight);
  }
  [[nodiscard]] double v(double value) const {
    return height - kBottom - (value - y.low) / y.size() * (height - kTop - kBottom);
  }
};

/// Grid and axes with their numbers, one every step.
[[nodiscard]] std::string grid_svg(const Canvas& canvas, double step_x, double step_y);

struct LegendEntry {
  std::string label;
  bool dots = false;  ///< a dot instead of a line
};
/// The labels in a row between title and plot, coloured by their order.
[[nodiscard]] std::string legend_svg(const std::vector<LegendEntry>& entries);
[[nodiscard]] std::string svg_dot(double u, double v, double radius, std::size_t colour);
/// The <svg> element around what is inside.
[[nodiscard]] std::string framed(const std::string& title, double height,
                                 const std::string& inside);
[[nodiscard]] std::string empty_svg(const std::string& title);

}  // namespace oneac::internal
