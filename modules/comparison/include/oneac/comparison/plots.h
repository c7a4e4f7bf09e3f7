#pragma once

#include <string>
#include <vector>

namespace oneac {

/// The values of one method; infinite ones keep its curve below one.
struct CdfCurve {
  std::string label;
  std::vector<double> values;
};

/// A figure of cumulative distributions over a logarithmic axis.
struct CdfPlot {
  std::string title;
  std::string x_label;         ///< with unit
  bool show_exponent = false;  ///< ticks read log10 of the value
  std::vector<CdfCurve> curves;
};

/// An <svg> element to stand inside an HTML page; colours are the CSS classes c0 … c9, dash
/// patterns d0 … d3, so that the page decides for light and dark. Curve i has the class m<i>.
/// Values that are not positive count as the left end of the axis.
[[nodiscard]] std::string cdf_svg(const CdfPlot& plot);

}  // namespace oneac
