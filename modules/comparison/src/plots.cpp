#include "oneac/comparison/plots.h"

#include "text.h"

#include "oneac/evaluation/html_page.h"

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

using internal::decimals;

// Layout [px].
constexpr double kWidth = 520.0, kHeight = 320.0;
constexpr double kLeft = 46.0, kRight = 14.0, kTop = 34.0, kBottom = 46.0;
constexpr int kSamples = 240;  // points of a curve: about two pixels
constexpr std::size_t kColours = 10, kDashes = 4;
constexpr double kFirstDecade = -4.0, kLastDecade = 7.0;  // what an axis may show at most

std::string at(double value) {
  return decimals(value, 1);
}

/// The axis in decades.
struct Axis {
  double low = 0.0, high = 1.0;

  [[nodiscard]] double u(double decade) const {
    return kLeft + (decade - low) / (high - low) * (kWidth - kLeft - kRight);
  }
};
double v(double share) {
  return kHeight - kBottom - share * (kHeight - kTop - kBottom);
}

/// From the 1 % to the 99.5 % value, in whole decades: a stray value does not squeeze the rest.
Axis axis_of(const CdfPlot& plot) {
  std::vector<double> values;
  for (const CdfCurve& curve : plot.curves) {
    for (const double value : curve.values) {
      if (value > 0.0 && std::isfinite(value)) values.push_back(std::log10(value));
    }
  }
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto rank = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  Axis axis{std::max(std::floor(rank(0.01)), kFirstDecade),
            std::min(std::ceil(rank(0.995)), kLastDecade)};
  if (axis.high <= axis.low) axis.high = axis.low + 1.0;
  return axis;
}

std::string line(const char* kind, double u1, double v1, double u2, double v2) {
  return "<line class=\"" + std::string(kind) + "\" x1=\"" + at(u1) + "\" y1=\"" + at(v1) +
         "\" x2=\"" + at(u2) + "\" y2=\"" + at(v2) + "\"/>\n";
}

std::string text(double u, double y, const std::string& what, const char* anchor) {
  return "<text x=\"" + at(u) + "\" y=\"" + at(y) + "\" text-anchor=\"" + anchor + "\">" +
         html_escaped(what) + "</text>\n";
}

std::string decade_text(double decade, bool exponent) {
  if (exponent) return decimals(decade, 0);
  return decimals(std::pow(10.0, decade), std::max(0, static_cast<int>(-decade)));
}

std::string grid(const CdfPlot& plot, const Axis& axis) {
  std::string svg;
  const int decades = static_cast<int>(std::lround(axis.high - axis.low));
  for (int i = 0; i <= decades; ++i) {
    const double decade = axis.low + i;
    svg += line("grid", axis.u(decade), v(0.0), axis.u(decade), v(1.0));
    svg += text(axis.u(decade), v(0.0) + 16.0, decade_text(decade, plot.show_exponent), "middle");
    for (int digit = 2; digit < 10 && i < decades; ++digit) {
      const double u = axis.u(decade + std::log10(digit));
      svg += line("fine", u, v(0.0), u, v(1.0));
    }
  }
  for (int i = 0; i <= 4; ++i) {
    const double share = 0.25 * i;
    svg += line("grid", kLeft, v(share), kWidth - kRight, v(share));
    svg += text(kLeft - 6.0, v(share) + 4.0, decimals(share, 2), "end");
  }
  return svg;
}

std::string curve_path(const CdfCurve& curve, std::size_t number, const Axis& axis) {
  std::vector<double> decades;
  for (const double value : curve.values) {
    if (std::isfinite(value)) decades.push_back(value > 0.0 ? std::log10(value) : kFirstDecade);
  }
  std::sort(decades.begin(), decades.end());
  const double count = static_cast<double>(curve.values.size());
  std::string path;
  for (int i = 0; i <= kSamples && count > 0.0; ++i) {
    const double decade = axis.low + (axis.high - axis.low) * i / kSamples;
    const auto below = std::upper_bound(decades.begin(), decades.end(), decade) - decades.begin();
    path += (path.empty() ? "M" : "L") + at(axis.u(decade)) + " " +
            at(v(static_cast<double>(below) / count));
  }
  return "<path class=\"curve c" + std::to_string(number % kColours) + " d" +
         std::to_string(number / kColours % kDashes) + " m" + std::to_string(number) + "\" d=\"" +
         path + "\"><title>" + html_escaped(curve.label) + "</title></path>\n";
}

}  // namespace

std::string cdf_svg(const CdfPlot& plot) {
  const Axis axis = axis_of(plot);
  std::string svg = "<svg class=\"cdf\" viewBox=\"0 0 " + decimals(kWidth, 0) + " " +
                    decimals(kHeight, 0) + "\" role=\"img\" aria-label=\"" +
                    html_escaped(plot.title) + "\">\n";
  svg += "<text class=\"title\" x=\"" + at(kLeft) + "\" y=\"20\">" + html_escaped(plot.title) +
         "</text>\n";
  svg += grid(plot, axis);
  for (std::size_t i = 0; i < plot.curves.size(); ++i) svg += curve_path(plot.curves[i], i, axis);
  svg += text(0.5 * (kLeft + kWidth - kRight), kHeight - 8.0, plot.x_label, "middle");
  return svg + "</svg>\n";
}

}  // namespace oneac
