#include "oneac/evaluation/svg_plot.h"

#include "svg_canvas.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace oneac {
namespace {

using internal::Canvas;
using internal::colour_class;
using internal::empty_svg;
using internal::framed;
using internal::grid_svg;
using internal::kBottom;
using internal::kLeft;
using internal::kPlanHeight;
using internal::kPlotHeight;
using internal::kRight;
using internal::kTop;
using internal::kWidth;
using internal::legend_svg;
using internal::LegendEntry;
using internal::nice_step;
using internal::padded;
using internal::place;
using internal::Range;
using internal::svg_dot;
using internal::svg_text;
using internal::tick_label;

// [px]
constexpr double kDot = 2.2, kStart = 4.5;
constexpr double kColumn = 0.5;  // points that share one are drawn as their extremes
constexpr int kTicksX = 8, kTicksY = 5, kTicksPlan = 8;

struct Spot {
  double u, v;
};
/// What is drawn without lifting the pen.
using Stroke = std::vector<Spot>;

/// Points of one pixel column become the lowest and the highest of them, in their order.
Stroke thinned(const Stroke& stroke) {
  Stroke thin;
  for (std::size_t i = 0; i < stroke.size();) {
    std::size_t end = i, low = i, high = i;
    for (; end < stroke.size() && std::abs(stroke[end].u - stroke[i].u) < kColumn; ++end) {
      if (stroke[end].v < stroke[low].v) low = end;
      if (stroke[end].v > stroke[high].v) high = end;
    }
    thin.push_back(stroke[std::min(low, high)]);
    if (low != high) thin.push_back(stroke[std::max(low, high)]);
    i = end;
  }
  return thin;
}

std::vector<Stroke> strokes_of(const PlotSeries& series, const Canvas& canvas) {
  std::vector<Stroke> strokes(1);
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (std::isfinite(series.y[i]) && std::isfinite(series.x[i])) {
      strokes.back().push_back({canvas.u(series.x[i]), canvas.v(series.y[i])});
    } else if (!strokes.back().empty()) {
      strokes.emplace_back();
    }
  }
  for (Stroke& stroke : strokes) stroke = thinned(stroke);
  return strokes;
}

std::string dots_svg(const Stroke& stroke, std::size_t number) {
  std::string svg;
  for (const Spot& spot : stroke) {
    svg += svg_dot(spot.u, spot.v, kDot, number);
  }
  return svg;
}

std::string stroke_svg(const Stroke& stroke, std::size_t number) {
  if (stroke.size() < 2) return dots_svg(stroke, number);
  std::string points;
  for (const Spot& spot : stroke) {
    points += (points.empty() ? "" : " ") + place(spot.u) + "," + place(spot.v);
  }
  return "<polyline class=\"curve " + colour_class(number) + "\" points=\"" + points + "\"/>\n";
}

Canvas canvas_of(const SeriesPlot& plot) {
  Canvas canvas;
  for (const PlotSeries& series : plot.series) {
    if (series.x.size() != series.y.size()) {
      throw std::invalid_argument("plot: " + series.label + " needs one y per x");
    }
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) continue;
      canvas.x.add(series.x[i]);
      canvas.y.add(series.y[i]);
    }
  }
  return canvas;
}

/// Both axes with the same scale: the shorter range grows about its middle.
Canvas canvas_of(const PlanView& plan) {
  Canvas canvas;
  canvas.height = kPlanHeight;
  for (const PlanPath& path : plan.paths) {
    for (const Eigen::Vector2d& point : path.points) {
      if (!point.allFinite()) continue;
      canvas.x.add(point.x());
      canvas.y.add(point.y());
    }
  }
  if (canvas.x.empty()) return canvas;
  canvas.x = padded(canvas.x);
  canvas.y = padded(canvas.y);
  const double wide = kWidth - kLeft - kRight, high = kPlanHeight - kTop - kBottom;
  const double scale = std::max({canvas.x.size() / wide, canvas.y.size() / high});
  const auto grow = [&](Range& range, double size) {
    const double middle = 0.5 * (range.low + range.high);
    range = {middle - 0.5 * size, middle + 0.5 * size};
  };
  grow(canvas.x, scale * wide);
  grow(canvas.y, scale * high);
  return canvas;
}

std::string path_svg(const PlanPath& path, std::size_t number, const Canvas& canvas) {
  Stroke stroke;
  for (const Eigen::Vector2d& point : path.points) {
    if (!point.allFinite()) continue;
    const Spot spot{canvas.u(point.x()), canvas.v(point.y())};
    const bool far =
        stroke.empty() || std::hypot(spot.u - stroke.back().u, spot.v - stroke.back().v) >= kColumn;
    if (far) stroke.push_back(spot);
  }
  if (stroke.empty()) return "";
  if (path.dots) return dots_svg(stroke, number);
  return stroke_svg(stroke, number) + svg_dot(stroke.front().u, stroke.front().v, kStart, number);
}

}  // namespace

std::string plot_svg(const SeriesPlot& plot) {
  Canvas canvas = canvas_of(plot);
  if (canvas.x.empty()) return empty_svg(plot.title);
  if (!(canvas.x.size() > 0.0)) canvas.x = padded(canvas.x);
  if (plot.from_zero) canvas.y.add(0.0);
  const double zero = canvas.y.low;
  canvas.y = padded(canvas.y);
  if (plot.from_zero && !(zero < 0.0)) canvas.y.low = 0.0;
  std::string svg =
      grid_svg(canvas, nice_step(canvas.x.size(), kTicksX), nice_step(canvas.y.size(), kTicksY));
  std::vector<LegendEntry> entries;
  for (const PlotSeries& series : plot.series) entries.push_back({series.label, series.dots});
  for (std::size_t i = plot.series.size(); i-- > 0;) {  // the first on top
    for (const Stroke& stroke : strokes_of(plot.series[i], canvas)) {
      svg += plot.series[i].dots ? dots_svg(stroke, i) : stroke_svg(stroke, i);
    }
  }
  svg += svg_text(kWidth - kRight, kPlotHeight - 8.0, plot.x_label, "end");
  svg += svg_text(kWidth - kRight, 22.0, plot.y_label, "end");
  return framed(plot.title, kPlotHeight, svg + legend_svg(entries));
}

std::string plan_svg(const PlanView& plan) {
  const Canvas canvas = canvas_of(plan);
  if (canvas.x.empty()) return empty_svg(plan.title);
  const double step = nice_step(std::max(canvas.x.size(), canvas.y.size()), kTicksPlan);
  std::string svg = grid_svg(canvas, step, step);
  std::vector<LegendEntry> entries;
  for (const PlanPath& path : plan.paths) entries.push_back({path.label, path.dots});
  for (std::size_t i = plan.paths.size(); i-- > 0;) svg += path_svg(plan.paths[i], i, canvas);
  svg += svg_text(kWidth - kRight, 22.0, "grid " + tick_label(step, step) + " " + plan.unit, "end");
  return framed(plan.title, kPlanHeight, svg + legend_svg(entries));
}

}  // namespace oneac
