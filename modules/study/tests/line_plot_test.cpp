#include "oneac/study/line_plot.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace oneac {
namespace {

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

LinePlot some_plot() {
  return {"Title", "Subtitle",       "x [px]",
          "y [°]", {-1.0, 0.0, 1.0}, {{"A < B", {0.0, 1.0, 2.0}}, {"C & D", {2.0, 1.5, 1.0}}}};
}

TEST(LinePlot, ShowsTitleAxesWithUnitsAndLegend) {
  const std::string svg = svg_of(some_plot());
  for (const char* part : {">Title<", ">Subtitle<", ">x [px]<", ">y [°]<", ">A &lt; B<",
                           ">C &amp; D<", ">−1.0<", ">0.0<", ">2.0<"}) {
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  }
}

TEST(LinePlot, DrawsACurveAndAMarkerPerPoint) {
  const std::string svg = svg_of(some_plot());
  EXPECT_EQ(count(svg, "<polyline"), 2U);
  EXPECT_EQ(count(svg, "<circle"), 3U + 1U);  // one in the legend
  EXPECT_EQ(count(svg, "<polygon"), 3U + 1U);
  EXPECT_EQ(svg.rfind("<svg", 0), 0U);
  EXPECT_NE(svg.find("fill=\"#ffffff\""), std::string::npos);
}

TEST(LinePlot, PutsZeroAtTheBottomAndLargerUp) {
  const std::string svg = svg_of(some_plot());
  const auto at = svg.find("<polyline points=\"");
  // The last curve is drawn first: 2, 1.5, 1 go down the page.
  double u[3], v[3];
  ASSERT_EQ(std::sscanf(svg.c_str() + at, "<polyline points=\"%lf,%lf %lf,%lf %lf,%lf", &u[0],
                        &v[0], &u[1], &v[1], &u[2], &v[2]),
            6);
  EXPECT_LT(u[0], u[1]);
  EXPECT_LT(v[0], v[1]);
  EXPECT_LT(v[1], v[2]);
}

TEST(LinePlot, RejectsWhatItCannotDraw) {
  LinePlot plot = some_plot();
  plot.curves[0].y[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)svg_of(plot), std::invalid_argument);
  plot = some_plot();
  plot.curves[1].y.pop_back();
  EXPECT_THROW((void)svg_of(plot), std::invalid_argument);
  plot = some_plot();
  plot.x = {1.0};
  plot.curves.clear();
  EXPECT_THROW((void)svg_of(plot), std::invalid_argument);
}

TEST(LinePlot, DrawsAllZeros) {
  LinePlot plot = some_plot();
  for (PlotCurve& curve : plot.curves) curve.y = {0.0, 0.0, 0.0};
  EXPECT_EQ(svg_of(plot).find("nan"), std::string::npos);
}

TEST(LinePlot, TicksAreOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(tick_step(1.0, 10), 0.1);
  EXPECT_DOUBLE_EQ(tick_step(160.0, 10), 20.0);
  EXPECT_DOUBLE_EQ(tick_step(0.27, 6), 0.05);
  EXPECT_DOUBLE_EQ(tick_step(9.0, 1), 10.0);
}

}  // namespace
}  // namespace oneac
