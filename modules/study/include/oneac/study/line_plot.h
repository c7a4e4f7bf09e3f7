#pragma once

#include <string>
#include <vector>

namespace oneac {

/// A curve: one y for each x of the plot.
struct PlotCurve {
  std::string label;
  std::vector<double> y;
};

/// A line plot over common abscissae; y starts at zero.
struct LinePlot {
  std::string title;
  std::string subtitle;
  std::string x_label;  ///< with unit
  std::string y_label;  ///< with unit
  std::vector<double> x;
  std::vector<PlotCurve> curves;  ///< up to four look different
};

/// The plot as an SVG document, 720×450, light background. Colours tell apart for the colour-blind,
/// and every curve has a marker of its own.
/// @throws std::invalid_argument when a curve has not one finite y ≥ 0 per x, or there are no two x
[[nodiscard]] std::string svg_of(const LinePlot& plot);

/// Distance of ticks that gives about `count` of them over `range` > 0: 1, 2 or 5 times a power of
/// ten.
[[nodiscard]] double tick_step(double range, int count);

}  // namespace oneac
