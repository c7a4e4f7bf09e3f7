#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace oneac {

/// A quantity over the abscissa, in its order. A y that is not finite leaves a gap.
struct PlotSeries {
  std::string label;
  std::vector<double> x;
  std::vector<double> y;
  bool dots = false;  ///< samples of a slow sensor: dots instead of a line
};

/// A plot over time or another quantity that grows.
struct SeriesPlot {
  std::string title;
  std::string x_label;  ///< with unit
  std::string y_label;  ///< with unit
  std::vector<PlotSeries> series;
  bool from_zero = false;  ///< the ordinate starts at zero
};

/// A way over the ground, seen from above.
struct PlanPath {
  std::string label;
  std::vector<Eigen::Vector2d> points;  ///< to the right, up on the page
  bool dots = false;
};

/// Ways over a square grid; both axes have the same scale.
struct PlanView {
  std::string title;
  std::string unit;  ///< of the points: "m" or "units"
  std::vector<PlanPath> paths;
};

/// An <svg> element to stand in an HtmlPage, whose style sheet colours it for light and dark:
/// axes, grid, legend, one curve per series (up to six colours). Points closer than half a pixel
/// are drawn as their extremes. Without a finite point the plot says so.
/// @throws std::invalid_argument when x and y of a series differ in size
[[nodiscard]] std::string plot_svg(const SeriesPlot& plot);

/// The same for a plan; every path's first point is marked.
[[nodiscard]] std::string plan_svg(const PlanView& plan);

}  // namespace oneac
