#include "svg_canvas.h"

#include "oneac/base/number_text.h"
#include "oneac/report/html_page.h"

#include <array>
#include <cmath>

namespace oneac::internal {
namespace {

constexpr std::size_t kColours = 10, kDashes = 4, kShapes = 4;
constexpr double kLetter = 6.4;  // [px] mean width of a letter of the legend
constexpr double kSign = 18.0, kGap = 14.0, kRow = 17.0;  // [px] of an entry of the legend
constexpr double kDot = 2.2, kRing = 2.4, kMarker = 3.2;  // [px]
constexpr double kMargin = 0.04;  // of the range, so that no curve runs along the frame
constexpr int kTicksX = 8, kTicksY = 5;

/// Number of characters of UTF-8, not bytes.
double letters(const std::string& text) {
  return static_cast<double>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string line(const std::string& style, double u1, double v1, double u2, double v2) {
  return "<line class=\"" + style + "\" x1=\"" + place(u1) + "\" y1=\"" + place(v1) + "\" x2=\"" +
         place(u2) + "\" y2=\"" + place(v2) + "\"/>\n";
}

/// A multiple of the step with as many decimals as it needs.
std::string tick_label(double value, double step) {
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  const std::string text = fixed_text(value, digits);
  return text.front() == '-' ? "−" + text.substr(1) : text;  // a minus, not a hyphen
}

std::string vertical(const Canvas& canvas, double x, const std::string& label) {
  return line("grid", canvas.u(x), canvas.top, canvas.u(x), canvas.bottom()) +
         svg_text(canvas.u(x), canvas.bottom() + 16.0, label, "middle");
}

std::string decades_svg(const Canvas& canvas) {
  std::string svg;
  for (double decade = canvas.x.low; decade <= canvas.x.high; decade += 1.0) {
    const int digits = std::max(0, static_cast<int>(-decade));
    for (int digit = 2; digit < 10 && decade < canvas.x.high; ++digit) {
      const double u = canvas.u(decade + std::log10(digit));
      svg += line("fine", u, canvas.top, u, canvas.bottom());
    }
    svg += vertical(canvas, decade, fixed_text(std::pow(10.0, decade), digits));
  }
  return svg;
}

double plan_step(const Canvas& canvas) {
  return tick_step(std::max(canvas.x.size(), canvas.y.size()), kTicksX);
}

/// Every multiple of the step in the range.
template <class Draw>
void each_tick(const Range& range, double step, Draw&& draw) {
  for (double i = std::ceil(range.low / step - 1e-9); i * step <= range.high + 1e-9 * step;
       i += 1.0) {
    draw(i * step);
  }
}

}  // namespace

std::string place(double value) {
  return fixed_text(value, 1);
}

std::string series_class(std::size_t number) {
  return "c" + std::to_string(number % kColours) + " d" +
         std::to_string(number / kColours % kDashes) + " m" + std::to_string(number);
}

std::string svg_text(double u, double v, const std::string& text, const char* anchor,
                     const char* style) {
  return "<text class=\"" + std::string(style) + "\" x=\"" + place(u) + "\" y=\"" + place(v) +
         "\" text-anchor=\"" + anchor + "\">" + html_escaped(text) + "</text>\n";
}

Range padded(Range range) {
  const double least = std::max(1e-6, 1e-3 * std::max(std::abs(range.low), std::abs(range.high)));
  const double room = range.size() > least ? kMargin * range.size() : least;
  return {range.low - room, range.high + room};
}

std::string grid_svg(const Canvas& canvas, Axes axes) {
  const bool plan = axes == Axes::kPlan;
  const double step_x = plan ? plan_step(canvas) : tick_step(canvas.x.size(), kTicksX);
  const double step_y = plan ? step_x : tick_step(canvas.y.size(), kTicksY);
  std::string svg;
  if (axes == Axes::kDecades) {
    svg = decades_svg(canvas);
  } else {
    each_tick(canvas.x, step_x,
              [&](double x) { svg += vertical(canvas, x, tick_label(x, step_x)); });
  }
  const double right = kWidth - kRight;
  each_tick(canvas.y, step_y, [&](double y) {
    svg += line("grid", kLeft, canvas.v(y), right, canvas.v(y));
    svg += svg_text(kLeft - 6.0, canvas.v(y) + 4.0, tick_label(y, step_y), "end");
  });
  svg += line("axis", kLeft, canvas.bottom(), right, canvas.bottom());
  return svg + line("axis", kLeft, canvas.top, kLeft, canvas.bottom());
}

std::string grid_size(const Canvas& canvas, const std::string& unit) {
  const double step = plan_step(canvas);
  return tick_label(step, step) + " " + unit;
}

std::string mark_svg(Pen pen, double u, double v, std::size_t number) {
  const std::string style = "\" class=\"" + std::string(pen == Pen::kRings ? "ring " : "dot ") +
                            series_class(number) + "\"/>\n";
  const std::size_t shape = pen == Pen::kMarkers ? number % kShapes : 0;
  if (shape == 0) {
    const double r = pen == Pen::kMarkers ? kMarker : pen == Pen::kRings ? kRing : kDot;
    return "<circle cx=\"" + place(u) + "\" cy=\"" + place(v) + "\" r=\"" + place(r) + style;
  }
  using Corners = std::array<std::array<double, 2>, 4>;  // square, triangle, diamond
  static constexpr std::array<Corners, kShapes - 1> kCorners = {
      {{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}},
       {{{0, -1.2}, {0, -1.2}, {1.2, 1}, {-1.2, 1}}},
       {{{0, -1.4}, {1.4, 0}, {0, 1.4}, {-1.4, 0}}}}};
  std::string points;
  for (const auto& corner : kCorners[shape - 1]) {
    points += (points.empty() ? "" : " ") + place(u + kMarker * corner[0]) + "," +
              place(v + kMarker * corner[1]);
  }
  return "<polygon points=\"" + points + style;
}

Legend legend_of(const Plot& plot) {
  Legend legend{"", plot.subtitle.empty() ? 36.0 : 52.0};
  if (!plot.legend || plot.series.empty()) return legend;
  double u = kLeft, v = legend.bottom + 4.0;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const PlotSeries& series = plot.series[i];
    const double width = kSign + 5.0 + kLetter * letters(series.label);
    if (u > kLeft && u + width > kWidth - kRight) u = kLeft, v += kRow;
    const bool has_line = series.pen == Pen::kLine || series.pen == Pen::kMarkers;
    if (has_line) legend.svg += line("curve " + series_class(i), u, v, u + kSign, v);
    if (series.pen != Pen::kLine) legend.svg += mark_svg(series.pen, u + 0.5 * kSign, v, i);
    legend.svg += svg_text(u + kSign + 5.0, v + 4.0, series.label, "start");
    u += width + kGap;
  }
  legend.bottom = v + 14.0;
  return legend;
}

}  // namespace oneac::internal

namespace oneac {

double tick_step(double range, int count) {
  const double rough = range / std::max(count, 1);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

}  // namespace oneac
