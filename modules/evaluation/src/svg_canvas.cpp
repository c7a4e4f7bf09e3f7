#include "svg_canvas.h"

#include "text_io.h"

#include "oneac/evaluation/html_page.h"

#include <algorithm>
#include <cmath>

namespace oneac::internal {

namespace {
constexpr std::size_t kColours = 6;
constexpr double kLetter = 6.6;     // [px] mean width of a letter of the legend
constexpr double kLegendDot = 3.0;  // [px]
constexpr double kMargin = 0.04;    // of the range, so that no curve runs along the frame

/// Number of characters of UTF-8, not bytes.
double letters(const std::string& text) {
  return static_cast<double>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::string place(double value) {
  return fixed_text(value, 1);
}

std::string colour_class(std::size_t number) {
  return "c" + std::to_string(number % kColours);
}

std::string svg_line(const char* style, double u1, double v1, double u2, double v2) {
  return "<line class=\"" + std::string(style) + "\" x1=\"" + place(u1) + "\" y1=\"" + place(v1) +
         "\" x2=\"" + place(u2) + "\" y2=\"" + place(v2) + "\"/>\n";
}

std::string svg_text(double u, double v, const std::string& text, const char* anchor,
                     const char* style) {
  return "<text class=\"" + std::string(style) + "\" x=\"" + place(u) + "\" y=\"" + place(v) +
         "\" text-anchor=\"" + anchor + "\">" + html_escaped(text) + "</text>\n";
}

double nice_step(double range, int count) {
  const double rough = range / std::max(count, 1);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

std::string tick_label(double value, double step) {
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  const std::string text = fixed_text(value, digits);
  return text.front() == '-' ? "−" + text.substr(1) : text;  // a minus, not a hyphen
}

Range padded(Range range) {
  const double least = std::max(1e-6, 1e-3 * std::max(std::abs(range.low), std::abs(range.high)));
  const double room = range.size() > least ? kMargin * range.size() : least;
  return {range.low - room, range.high + room};
}

std::string grid_svg(const Canvas& canvas, double step_x, double step_y) {
  std::string svg;
  const double bottom = canvas.height - kBottom, right = kWidth - kRight;
  for (double i = std::ceil(canvas.x.low / step_x); i * step_x <= canvas.x.high; i += 1.0) {
    const double u = canvas.u(i * step_x);
    svg += svg_line("grid", u, kTop, u, bottom);
    svg += svg_text(u, bottom + 16.0, tick_label(i * step_x, step_x), "middle");
  }
  for (double i = std::ceil(canvas.y.low / step_y); i * step_y <= canvas.y.high; i += 1.0) {
    const double v = canvas.v(i * step_y);
    svg += svg_line("grid", kLeft, v, right, v);
    svg += svg_text(kLeft - 6.0, v + 4.0, tick_label(i * step_y, step_y), "end");
  }
  svg += svg_line("axis", kLeft, bottom, right, bottom);
  return svg + svg_line("axis", kLeft, kTop, kLeft, bottom);
}

std::string legend_svg(const std::vector<LegendEntry>& entries) {
  std::string svg;
  double u = kLeft;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::string style = "curve " + colour_class(i);
    svg += entries[i].dots ? svg_dot(u + 9.0, kTop - 14.0, kLegendDot, i)
                           : svg_line(style.c_str(), u, kTop - 14.0, u + 18.0, kTop - 14.0);
    svg += svg_text(u + 23.0, kTop - 10.0, entries[i].label, "start");
    u += 37.0 + kLetter * letters(entries[i].label);
  }
  return svg;
}

std::string svg_dot(double u, double v, double radius, std::size_t colour) {
  return "<circle class=\"dot " + colour_class(colour) + "\" cx=\"" + place(u) + "\" cy=\"" +
         place(v) + "\" r=\"" + place(radius) + "\"/>\n";
}

std::string framed(const std::string& title, double height, const std::string& inside) {
  return "<svg class=\"plot\" role=\"img\" aria-label=\"" + html_escaped(title) +
         "\" viewBox=\"0 0 " + place(kWidth) + " " + place(height) + "\">\n" +
         svg_text(kLeft, 22.0, title, "start", "title") + inside + "</svg>\n";
}

std::string empty_svg(const std::string& title) {
  return framed(title, kPlotHeight, svg_text(kLeft, kTop + 20.0, "no values", "start"));
}

}  // namespace oneac::internal
