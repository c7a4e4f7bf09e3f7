#include "oneac/evaluation/svg_plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace oneac {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

/// Places of the points of the first line of a colour.
std::vector<std::pair<double, double>> points_of(const std::string& svg, const std::string& style) {
  const std::string before = "class=\"curve " + style + "\" points=\"";
  std::vector<std::pair<double, double>> points;
  const auto found = svg.find(before);  // a long line takes std::regex more stack than there is
  if (found == std::string::npos) return points;
  const auto begin = found + before.size();
  std::istringstream text(svg.substr(begin, svg.find('"', begin) - begin));
  double u = 0.0;
  double v = 0.0;
  char comma = ' ';
  while (text >> u >> comma >> v) points.emplace_back(u, v);
  return points;
}

TEST(PlotSvg, RisesToTheRightWhereValuesGrow) {
  const auto points = points_of(
      plot_svg({"speed", "s", "m/s", {{"a", {0.0, 1.0, 2.0}, {0.0, 5.0, 10.0}}}, true}), "c0");
  ASSERT_EQ(points.size(), 3U);
  EXPECT_LT(points[0].first, points[1].first);
  EXPECT_GT(points[0].second, points[1].second);  // v grows downwards
  EXPECT_NEAR(points[0].second - points[1].second, points[1].second - points[2].second, 0.15);
}

TEST(PlotSvg, NamesTitleAxesAndSeries) {
  const std::string svg =
      plot_svg({"A & B", "time [s]", "x < y", {{"one", {0, 1}, {1, 2}}, {"two", {0, 1}, {2, 1}}}});
  for (const char* text : {"A &amp; B", "time [s]", "x &lt; y", ">one<", ">two<"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
  EXPECT_EQ(count(svg, "<polyline"), 2U);
}

TEST(PlotSvg, LeavesGapsWhereThereIsNoValue) {
  const std::string svg =
      plot_svg({"t", "", "", {{"a", {0, 1, 2, 3, 4}, {1, 2, kNan, 2, 1}}}, false});
  EXPECT_EQ(count(svg, "<polyline"), 2U);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(PlotSvg, SaysSoWithoutValues) {
  EXPECT_NE(plot_svg({"t", "", "", {{"a", {0.0}, {kNan}}}}).find("no values"), std::string::npos);
  EXPECT_NE(plot_svg({"t", "", "", {}}).find("no values"), std::string::npos);
}

TEST(PlotSvg, DrawsConstantsAndSinglePoints) {
  for (const std::vector<double>& x : {std::vector<double>{1.0}, {1.0, 2.0}}) {
    const std::string svg = plot_svg({"t", "", "", {{"a", x, std::vector<double>(x.size(), 3.0)}}});
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_EQ(count(svg, "class=\"curve c0\" points") + count(svg, "class=\"dot c0\""), 1U);
  }
}

TEST(PlotSvg, KeepsTheExtremesOfALongDrive) {
  PlotSeries series{"a", {}, {}, false};
  for (int i = 0; i < 100000; ++i) {
    series.x.push_back(i);
    series.y.push_back(i == 54321 ? 9.0 : 1.0);
  }
  const auto points = points_of(plot_svg({"t", "", "", {series}, true}), "c0");
  EXPECT_LT(points.size(), 2500U);
  const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                               [](auto a, auto b) { return a.second < b.second; });
  EXPECT_GT(high->second - low->second, 100.0);  // the spike is there
}

TEST(PlotSvg, RefusesSeriesThatDoNotFit) {
  EXPECT_THROW((void)plot_svg({"t", "", "", {{"a", {1.0, 2.0}, {1.0}}}}), std::invalid_argument);
}

TEST(PlanSvg, HasTheSameScaleInBothDirections) {
  const std::string svg = plan_svg({"t", "m", {{"a", {{0, 0}, {100, 0}, {100, 30}}}}});
  const auto points = points_of(svg, "c0");
  ASSERT_EQ(points.size(), 3U);
  const double right = points[1].first - points[0].first;
  const double up = points[1].second - points[2].second;
  EXPECT_NEAR(up / right, 0.3, 0.002);
  EXPECT_NE(svg.find("grid 20 m"), std::string::npos) << svg;
}

TEST(PlanSvg, DrawsAVehicleThatNeverMoved) {
  const std::string svg = plan_svg({"t", "m", {{"a", {{0, 0}, {0, 0}}}}});
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_NE(svg.find("class=\"dot c0\""), std::string::npos);
}

}  // namespace
}  // namespace oneac
