#include "oneac/comparison/plots.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

namespace oneac {
namespace {

/// Height of the last point of the first curve, 0 … 1 of the plot.
double end_of_curve(const std::string& svg) {
  const std::size_t path = svg.find("<path class=\"curve");
  const std::size_t end = svg.find("\"><title>", path);
  const std::size_t space = svg.rfind(' ', end);
  return (274.0 - std::stod(svg.substr(space + 1, end - space))) / 240.0;
}

TEST(CdfSvg, FailuresKeepTheCurveBelowOne) {
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(end_of_curve(cdf_svg({"t", "x", false, {{"a", {1, 2, 3, 4}}}})), 1.0, 1e-3);
  EXPECT_NEAR(end_of_curve(cdf_svg({"t", "x", false, {{"a", {1, 2, infinite, infinite}}}})), 0.5,
              1e-3);
}

TEST(CdfSvg, GivesEveryCurveItsClasses) {
  CdfPlot plot{"t", "x", false, {}};
  for (int i = 0; i < 12; ++i) plot.curves.push_back({"m", {1.0, 10.0}});
  const std::string svg = cdf_svg(plot);
  EXPECT_NE(svg.find("curve c0 d0 m0"), std::string::npos);
  EXPECT_NE(svg.find("curve c1 d1 m11"), std::string::npos);
}

TEST(CdfSvg, StandsWithoutValues) {
  EXPECT_EQ(cdf_svg({"t", "x", false, {{"a", {}}}}).find("nan"), std::string::npos);
  EXPECT_EQ(cdf_svg({"t", "x", true, {{"a", {0.0, 0.0}}}}).find("nan"), std::string::npos);
}

TEST(CdfSvg, EscapesNames) {
  EXPECT_EQ(cdf_svg({"<t>", "x", false, {{"<b>", {1.0}}}}).find("<b>"), std::string::npos);
}

}  // namespace
}  // namespace oneac
