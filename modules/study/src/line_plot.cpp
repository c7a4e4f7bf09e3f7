#include "oneac/study/line_plot.h"

#include "number_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace oneac {
namespace {

using internal::decimals;

// Layout [px].
constexpr double kWidth = 720.0, kHeight = 450.0;
constexpr double kLeft = 78.0, kRight = 24.0, kTop = 98.0, kBottom = 62.0;
constexpr double kMarker = 4.5;
constexpr double kLetter = 8.2;     // mean width of a letter of the legend
constexpr double kHeadroom = 1.02;  // so that no marker sticks out at the top
constexpr int kTicksX = 10, kTicksY = 6;
// Okabe and Ito's colours, which differ for every kind of colour vision.
constexpr std::array<const char*, 4> kColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7"};

[[nodiscard]] std::string at(double value) {
  return decimals(value, 2);
}

[[nodiscard]] std::string escaped(const std::string& text) {
  std::string safe;
  for (const char letter : text) {
    if (letter == '<') {
      safe += "&lt;";
    } else if (letter == '&') {
      safe += "&amp;";
    } else {
      safe += letter;
    }
  }
  return safe;
}

/// From numbers to places on the page.
struct Frame {
  double x_low, x_high, y_high;

  [[nodiscard]] double u(double x) const {
    return kLeft + (x - x_low) / (x_high - x_low) * (kWidth - kLeft - kRight);
  }
  [[nodiscard]] double v(double y) const {
    return kHeight - kBottom - y / y_high * (kHeight - kTop - kBottom);
  }
};

void check(const LinePlot& plot) {
  if (plot.x.size() < 2) throw std::invalid_argument("plot: x has fewer than two values");
  for (const PlotCurve& curve : plot.curves) {
    const bool good = curve.y.size() == plot.x.size() &&
                      std::all_of(curve.y.begin(), curve.y.end(),
                                  [](double y) { return std::isfinite(y) && y >= 0.0; });
    if (!good) {
      throw std::invalid_argument("plot: " + curve.label + " needs one finite y ≥ 0 per x");
    }
  }
}

[[nodiscard]] Frame frame_of(const LinePlot& plot) {
  double y_high = 0.0;
  for (const PlotCurve& curve : plot.curves) {
    for (const double y : curve.y) y_high = std::max(y_high, y);
  }
  const auto [low, high] = std::minmax_element(plot.x.begin(), plot.x.end());
  if (!(y_high > 0.0)) return {*low, *high, 1.0};
  const double step = tick_step(y_high, kTicksY);
  return {*low, *high, std::ceil(y_high * kHeadroom / step) * step};
}

[[nodiscard]] std::string text(double u, double v, const std::string& what,
                               const std::string& attributes) {
  return "<text x=\"" + at(u) + "\" y=\"" + at(v) + "\" " + attributes + ">" + escaped(what) +
         "</text>\n";
}

[[nodiscard]] std::string line(double u1, double v1, double u2, double v2, const char* stroke) {
  return "<line x1=\"" + at(u1) + "\" y1=\"" + at(v1) + "\" x2=\"" + at(u2) + "\" y2=\"" + at(v2) +
         "\" stroke=\"" + stroke + "\"/>\n";
}

[[nodiscard]] int decimals_of(double step) {
  return std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
}

[[nodiscard]] std::string tick_text(double value, double step) {
  const std::string digits = decimals(std::abs(value), decimals_of(step));
  return value < 0.0 ? "−" + digits : digits;  // a minus, not a hyphen
}

[[nodiscard]] std::string grid(const Frame& frame) {
  std::string svg;
  const double bottom = frame.v(0.0), right = kWidth - kRight;
  const double step_x = tick_step(frame.x_high - frame.x_low, kTicksX);
  const int first = static_cast<int>(std::ceil(frame.x_low / step_x - 1e-9));
  for (int i = first; i * step_x <= frame.x_high + 1e-9 * step_x; ++i) {
    const double u = frame.u(i * step_x);
    svg += line(u, kTop, u, bottom, "#e4e4e4");
    svg += text(u, bottom + 20.0, tick_text(i * step_x, step_x), "text-anchor=\"middle\"");
  }
  const double step_y = tick_step(frame.y_high, kTicksY);
  for (int i = 0; i * step_y <= frame.y_high * (1.0 + 1e-9); ++i) {
    const double v = frame.v(i * step_y);
    svg += line(kLeft, v, right, v, "#e4e4e4");
    svg += text(kLeft - 8.0, v + 5.0, tick_text(i * step_y, step_y), "text-anchor=\"end\"");
  }
  svg += line(kLeft, bottom, right, bottom, "#333333");
  svg += line(kLeft, kTop, kLeft, bottom, "#333333");
  return svg;
}

/// Circle, square, triangle, diamond: readable without colour as well.
[[nodiscard]] std::string marker(std::size_t kind, double u, double v) {
  const std::string fill = std::string("fill=\"") + kColours[kind % kColours.size()] + "\"/>\n";
  const double r = kMarker;
  if (kind % 4 == 0) {
    return "<circle cx=\"" + at(u) + "\" cy=\"" + at(v) + "\" r=\"" + at(r) + "\" " + fill;
  }
  const auto corner = [&](double du, double dv) { return at(u + du) + "," + at(v + dv) + " "; };
  std::string corners;
  if (kind % 4 == 1) corners = corner(-r, -r) + corner(r, -r) + corner(r, r) + corner(-r, r);
  if (kind % 4 == 2) corners = corner(0.0, -1.2 * r) + corner(1.2 * r, r) + corner(-1.2 * r, r);
  if (kind % 4 == 3) {
    corners =
        corner(0.0, -1.4 * r) + corner(1.4 * r, 0.0) + corner(0.0, 1.4 * r) + corner(-1.4 * r, 0.0);
  }
  corners.pop_back();
  return "<polygon points=\"" + corners + "\" " + fill;
}

[[nodiscard]] std::string curve_of(const Frame& frame, const LinePlot& plot, std::size_t kind) {
  const std::vector<double>& y = plot.curves[kind].y;
  std::string points, markers;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double u = frame.u(plot.x[i]), v = frame.v(y[i]);
    points += (i == 0 ? "" : " ") + at(u) + "," + at(v);
    markers += marker(kind, u, v);
  }
  return "<polyline points=\"" + points + "\" fill=\"none\" stroke-width=\"2.2\" stroke=\"" +
         kColours[kind % kColours.size()] + "\"/>\n" + markers;
}

/// Entries in a row between title and plot.
[[nodiscard]] std::string legend(const LinePlot& plot) {
  std::string svg;
  double u = kLeft;
  const double v = kTop - 20.0;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    svg += "<line x1=\"" + at(u) + "\" y1=\"" + at(v) + "\" x2=\"" + at(u + 30.0) + "\" y2=\"" +
           at(v) + "\" stroke-width=\"2.2\" stroke=\"" + kColours[i % kColours.size()] + "\"/>\n";
    svg += marker(i, u + 15.0, v);
    svg += text(u + 38.0, v + 5.0, plot.curves[i].label, "text-anchor=\"start\"");
    u += 66.0 + kLetter * static_cast<double>(plot.curves[i].label.size());
  }
  return svg;
}

}  // namespace

double tick_step(double range, int count) {
  const double rough = range / std::max(count, 1);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

std::string svg_of(const LinePlot& plot) {
  check(plot);
  const Frame frame = frame_of(plot);
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 720 450\" "
      "width=\"720\" height=\"450\" font-family=\"sans-serif\" font-size=\"15\" "
      "fill=\"#222222\">\n<rect width=\"720\" height=\"450\" fill=\"#ffffff\"/>\n";
  svg += text(kLeft, 32.0, plot.title, "font-size=\"18\" font-weight=\"bold\"");
  svg += text(kLeft, 51.0, plot.subtitle, "font-size=\"13\" fill=\"#666666\"");
  svg += grid(frame);
  svg +=
      text(0.5 * (kLeft + kWidth - kRight), kHeight - 16.0, plot.x_label, "text-anchor=\"middle\"");
  const std::string middle = at(0.5 * (kTop + kHeight - kBottom));
  svg += text(0.0, 0.0, plot.y_label,
              "text-anchor=\"middle\" transform=\"translate(22 " + middle + ") rotate(-90)\"");
  for (std::size_t i = plot.curves.size(); i-- > 0;) svg += curve_of(frame, plot, i);
  svg += legend(plot);
  return svg + "</svg>\n";
}

}  // namespace oneac
