#pragma once

#include <string>
#include <vector>

namespace oneac {

/// How a series is drawn.
enum class Pen {
  kLine,
  kDots,     ///< samples of a slow sensor
  kRings,    ///< hollow and below every line, so that they hide none
  kMarkers,  ///< a line with a shape at each point, another for each series
};

/// A quantity over the abscissa, in its order. A value that is not finite leaves a gap.
struct PlotSeries {
  std::string label;
  std::vector<double> x;
  std::vector<double> y;
  Pen pen = Pen::kLine;
};

enum class Axes {
  kLinear,
  kDecades,  ///< x is log10 of what its ticks say
  kPlan,     ///< seen from above: the same scale in both directions, each line's first point marked
};

/// Series over common axes.
struct Plot {
  std::string title;
  std::string x_label;  ///< with unit; of a plan: its unit
  std::string y_label;  ///< with unit
  std::vector<PlotSeries> series;
  bool from_zero = false;  ///< the ordinate starts at zero
  Axes axes = Axes::kLinear;
  std::string subtitle{};
  bool legend = true;
  double height = 300.0;  ///< [px] of 540 px of width; a plan makes its own
};

/// An <svg> element to stand in an HtmlPage, whose style sheet colours it for light and dark: axes,
/// grid, legend, series i in the classes c<i mod 10>, d<i / 10> (dashes) and m<i>. Points closer
/// than half a pixel are drawn as their extremes. Without a finite point the plot says so.
/// @throws std::invalid_argument when x and y of a series differ in size
[[nodiscard]] std::string plot_svg(const Plot& plot);

/// The same as an SVG document of 720 px of width, dark on white. @throws as plot_svg
[[nodiscard]] std::string plot_document(const Plot& plot);

/// Distance of ticks that gives about `count` of them over `range` > 0: 1, 2 or 5
/// times a power of ten.
[[nodiscard]] double tick_step(double range, int count);

}  // namespace oneac
