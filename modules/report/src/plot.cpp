#include "oneac/report/plot.h"

#include "page_style.h"
#include "svg_canvas.h"

#include "oneac/report/html_page.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace oneac {
namespace {

using internal::Canvas;
using internal::kLeft;
using internal::kRight;
using internal::kWidth;
using internal::mark_svg;
using internal::place;
using internal::Range;
using internal::svg_text;

constexpr double kColumn = 0.5;      // [px] points that share one are drawn as their extremes
constexpr double kDocument = 720.0;  // [px] wide

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

/// Points at least half a pixel apart: a way may turn back.
Stroke spaced(const Stroke& stroke) {
  Stroke apart;
  for (const Spot& spot : stroke) {
    const bool far =
        apart.empty() || std::hypot(spot.u - apart.back().u, spot.v - apart.back().v) >= kColumn;
    if (far) apart.push_back(spot);
  }
  return apart;
}

std::vector<Stroke> strokes_of(const PlotSeries& series, const Canvas& canvas, bool plan) {
  std::vector<Stroke> strokes(1);
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (std::isfinite(series.y[i]) && std::isfinite(series.x[i])) {
      strokes.back().push_back({canvas.u(series.x[i]), canvas.v(series.y[i])});
    } else if (!strokes.back().empty()) {
      strokes.emplace_back();
    }
  }
  for (Stroke& stroke : strokes) stroke = plan ? spaced(stroke) : thinned(stroke);
  return strokes;
}

std::string marks_svg(const Stroke& stroke, Pen pen, std::size_t number) {
  std::string svg;
  for (const Spot& spot : stroke) svg += mark_svg(pen, spot.u, spot.v, number);
  return svg;
}

std::string line_svg(const Stroke& stroke, const PlotSeries& series, std::size_t number) {
  if (stroke.size() < 2) return marks_svg(stroke, Pen::kDots, number);
  std::string points;
  for (const Spot& spot : stroke) {
    points += (points.empty() ? "" : " ") + place(spot.u) + "," + place(spot.v);
  }
  return "<polyline class=\"curve " + internal::series_class(number) + "\" points=\"" + points +
         "\"><title>" + html_escaped(series.label) + "</title></polyline>\n";
}

std::string series_svg(const PlotSeries& series, std::size_t number, const Canvas& canvas,
                       bool plan) {
  std::string svg;
  const std::vector<Stroke> strokes = strokes_of(series, canvas, plan);
  const bool has_line = series.pen == Pen::kLine || series.pen == Pen::kMarkers;
  for (const Stroke& stroke : strokes) {
    if (has_line) svg += line_svg(stroke, series, number);
    if (series.pen != Pen::kLine) svg += marks_svg(stroke, series.pen, number);
  }
  if (plan && has_line && !strokes.front().empty()) {
    svg += mark_svg(Pen::kMarkers, strokes.front().front().u, strokes.front().front().v, number);
  }
  return svg;
}

Canvas ranges_of(const Plot& plot) {
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
void make_square(Canvas& canvas) {
  canvas.x = internal::padded(canvas.x);
  canvas.y = internal::padded(canvas.y);
  const double wide = kWidth - kLeft - kRight, high = canvas.bottom() - canvas.top;
  const double scale = std::max(canvas.x.size() / wide, canvas.y.size() / high);
  const auto grow = [&](Range& range, double size) {
    const double middle = 0.5 * (range.low + range.high);
    range = {middle - 0.5 * size, middle + 0.5 * size};
  };
  grow(canvas.x, scale * wide);
  grow(canvas.y, scale * high);
}

void make_room(Canvas& canvas, bool from_zero) {
  if (!(canvas.x.size() > 0.0)) canvas.x = internal::padded(canvas.x);
  if (from_zero) canvas.y.add(0.0);
  const bool at_zero = from_zero && !(canvas.y.low < 0.0);
  canvas.y = internal::padded(canvas.y);
  if (at_zero) canvas.y.low = 0.0;
}

std::string labels_svg(const Plot& plot, const Canvas& canvas) {
  if (plot.axes == Axes::kPlan) {
    return svg_text(kWidth - kRight, 22.0, "grid " + internal::grid_size(canvas, plot.x_label),
                    "end");
  }
  return svg_text(kWidth - kRight, canvas.height - 8.0, plot.x_label, "end") +
         "<g transform=\"translate(14 " + place(0.5 * (canvas.top + canvas.bottom())) +
         ") rotate(-90)\">" + svg_text(0.0, 0.0, plot.y_label, "middle") + "</g>\n";
}

/// Lines lie on rings, the first series on the others.
std::string all_series_svg(const Plot& plot, const Canvas& canvas) {
  std::string svg;
  for (const bool rings : {true, false}) {
    for (std::size_t i = plot.series.size(); i-- > 0;) {
      if ((plot.series[i].pen == Pen::kRings) != rings) continue;
      svg += series_svg(plot.series[i], i, canvas, plot.axes == Axes::kPlan);
    }
  }
  return svg;
}

/// What is inside the <svg> element, and how high it is.
struct Drawing {
  std::string svg;
  double height;
};

Drawing drawing_of(const Plot& plot) {
  Canvas canvas = ranges_of(plot);
  const internal::Legend legend = internal::legend_of(plot);
  canvas.top = legend.bottom;
  canvas.height =
      plot.axes == Axes::kPlan && !canvas.x.empty() ? internal::kPlanHeight : plot.height;
  std::string svg = svg_text(kLeft, 22.0, plot.title, "start", "title");
  if (!plot.subtitle.empty()) svg += svg_text(kLeft, 39.0, plot.subtitle, "start");
  if (canvas.x.empty()) {
    return {svg + svg_text(kLeft, canvas.top + 20.0, "no values", "start"), canvas.height};
  }
  if (plot.axes == Axes::kPlan) {
    make_square(canvas);
  } else {
    make_room(canvas, plot.from_zero);
  }
  svg += internal::grid_svg(canvas, plot.axes) + all_series_svg(plot, canvas);
  return {svg + labels_svg(plot, canvas) + legend.svg, canvas.height};
}

std::string view_box(double height) {
  return "viewBox=\"0 0 " + place(kWidth) + " " + place(height) + "\"";
}

}  // namespace

std::string plot_svg(const Plot& plot) {
  const Drawing drawing = drawing_of(plot);
  return "<svg class=\"plot\" role=\"img\" aria-label=\"" + html_escaped(plot.title) + "\" " +
         view_box(drawing.height) + ">\n" + drawing.svg + "</svg>\n";
}

std::string plot_document(const Plot& plot) {
  const Drawing drawing = drawing_of(plot);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" " + view_box(drawing.height) +
         " width=\"" + place(kDocument) + "\" height=\"" +
         place(drawing.height * kDocument / kWidth) + "\">\n<style>" +
         internal::light_plot_style() +
         "</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" + drawing.svg +
         "</svg>\n";
}

}  // namespace oneac
