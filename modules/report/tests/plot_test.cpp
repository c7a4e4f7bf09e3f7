#include "oneac/report/plot.h"

#include "oneac/report/cdf.h"

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
  const std::string before = "class=\"curve " + style + " d0 m" + style.substr(1) + "\" points=\"";
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
    EXPECT_EQ(
        count(svg, "class=\"curve c0 d0 m0\" points") + count(svg, "class=\"dot c0 d0 m0\"/>\n<"),
        1U);
  }
}

TEST(PlotSvg, KeepsTheExtremesOfALongDrive) {
  PlotSeries series{"a", {}, {}, Pen::kLine};
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

Plot plan(std::vector<PlotSeries> series) {
  Plot plot{"t", "m", "", std::move(series)};
  plot.axes = Axes::kPlan;
  return plot;
}

TEST(PlanSvg, HasTheSameScaleInBothDirections) {
  const std::string svg = plot_svg(plan({{"a", {0, 100, 100}, {0, 0, 30}}}));
  const auto points = points_of(svg, "c0");
  ASSERT_EQ(points.size(), 3U);
  const double right = points[1].first - points[0].first;
  const double up = points[1].second - points[2].second;
  EXPECT_NEAR(up / right, 0.3, 0.002);
  EXPECT_NE(svg.find("grid 20 m"), std::string::npos) << svg;
}

TEST(PlanSvg, DrawsAVehicleThatNeverMoved) {
  const std::string svg = plot_svg(plan({{"a", {0, 0}, {0, 0}}}));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_NE(svg.find("class=\"dot c0"), std::string::npos);
}

TEST(PlanSvg, KeepsKeyframesBelowTheLines) {
  const std::string svg =
      plot_svg(plan({{"way", {0, 1}, {0, 1}}, {"keyframes", {0, 1}, {0, 1}, Pen::kRings}}));
  const auto ring = svg.find("class=\"ring c1"), way = svg.find("<polyline");
  ASSERT_NE(ring, std::string::npos);
  EXPECT_LT(ring, way);
}

TEST(PlotDocument, StandsAloneWithAMarkerPerPoint) {
  Plot plot{"Title", "x [px]", "y [°]", {}, true};
  plot.subtitle = "Subtitle";
  for (const char* label : {"A < B", "C & D"}) {
    plot.series.push_back({label, {-1.0, 0.0, 1.0}, {0.0, 1.0, 2.0}, Pen::kMarkers});
  }
  const std::string svg = plot_document(plot);
  EXPECT_EQ(svg.rfind("<svg xmlns=", 0), 0U);
  for (const char* part : {">Title<", ">Subtitle<", ">x [px]<", ">y [°]<", ">A &lt; B<",
                           ">C &amp; D<", ">−1.0<", ">0.0<", ">2.0<"}) {
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(count(svg, "<polyline"), 2U);
  EXPECT_EQ(count(svg, "<circle"), 3U + 1U);  // one in the legend
  EXPECT_EQ(count(svg, "<polygon"), 3U + 1U);
  EXPECT_EQ(svg.find("var("), std::string::npos);  // not every program knows variables
}

TEST(PlotSvg, WrapsALegendThatIsTooLong) {
  Plot plot{"t", "", "", {}};
  for (int i = 0; i < 8; ++i) plot.series.push_back({"a rather long label", {0, 1}, {0, 1}});
  const std::string svg = plot_svg(plot);
  for (auto at = svg.find("a rather long label</text>"); at != std::string::npos;
       at = svg.find("a rather long label</text>", at + 1)) {
    const auto x = svg.rfind("x=\"", svg.rfind("y=\"", at));
    EXPECT_LT(std::stod(svg.substr(x + 3)), 540.0 - 100.0);
  }
}

TEST(TickStep, IsOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(tick_step(1.0, 10), 0.1);
  EXPECT_DOUBLE_EQ(tick_step(160.0, 10), 20.0);
  EXPECT_DOUBLE_EQ(tick_step(0.27, 6), 0.05);
  EXPECT_DOUBLE_EQ(tick_step(9.0, 1), 10.0);
}

TEST(CdfPlot, FailuresKeepTheCurveBelowOne) {
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(cdf_plot("t", "x", {{"a", {1, 2, 3, 4}}}).series[0].y.back(), 1.0);
  EXPECT_DOUBLE_EQ(cdf_plot("t", "x", {{"a", {1, 2, infinite, infinite}}}).series[0].y.back(), 0.5);
}

TEST(CdfPlot, GivesEveryCurveItsClasses) {
  std::vector<Sample> samples;
  for (int i = 0; i < 12; ++i) samples.push_back({"m", {1.0, 10.0 + i}});
  const std::string svg = plot_svg(cdf_plot("t", "x", samples));
  EXPECT_NE(svg.find("curve c0 d0 m0"), std::string::npos);
  EXPECT_NE(svg.find("curve c1 d1 m11"), std::string::npos);
}

TEST(CdfPlot, HasTicksAtDecades) {
  const std::string svg = plot_svg(cdf_plot("t", "x", {{"a", {0.02, 0.5, 30.0, 30.0}}}));
  for (const char* tick : {">0.01<", ">0.1<", ">1<", ">10<", ">100<"}) {
    EXPECT_NE(svg.find(tick), std::string::npos) << tick;
  }
}

TEST(CdfPlot, StandsWithoutValues) {
  for (const std::vector<double>& values : {std::vector<double>{}, {0.0, 0.0}, {kNan}}) {
    EXPECT_EQ(plot_svg(cdf_plot("t", "x", {{"a", values}})).find("nan"), std::string::npos);
  }
}

TEST(Coinciding, NamesTheCurvesThatLieOnEachOther) {
  const Plot plot = cdf_plot(
      "t", "x", {{"a", {1, 2, 3}}, {"b", {10, 20, 30}}, {"c", {1, 2, 3}}, {"d", {}}, {"e", {}}});
  const std::vector<std::vector<std::string>> expected = {{"a", "c"}};
  EXPECT_EQ(coinciding(plot, 0.005), expected);
}

}  // namespace
}  // namespace oneac
