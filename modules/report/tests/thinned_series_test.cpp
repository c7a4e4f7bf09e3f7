#include "oneac/report/thinned_series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace oneac {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <class Value>
PlotSeries series_of(std::size_t count, Value&& value) {
  PlotSeries series;
  ThinnedSeries points(series, count);
  for (std::size_t i = 0; i < count; ++i) points.add(static_cast<double>(i), value(i));
  points.flush();
  return series;
}

double wave(std::size_t i) {
  return static_cast<double>(i % 7);
}

TEST(ThinnedSeries, KeepsEveryPointOfAShortDrive) {
  const PlotSeries series = series_of(kMostPlotted, wave);
  ASSERT_EQ(series.x.size(), kMostPlotted);
  ASSERT_EQ(series.y.size(), kMostPlotted);
  for (std::size_t i = 0; i < kMostPlotted; ++i) {
    ASSERT_EQ(series.x[i], static_cast<double>(i));
    ASSERT_EQ(series.y[i], wave(i));
  }
}

TEST(ThinnedSeries, DoesNotGrowWithTheDriveAndLosesNoExtreme) {
  constexpr std::size_t kCount = 1'000'000, kSpike = 777'777, kDip = 5;
  const PlotSeries series = series_of(kCount, [](std::size_t i) {
    if (i == kSpike) return 100.0;
    return i == kDip ? -100.0 : std::sin(0.01 * static_cast<double>(i));
  });
  EXPECT_LE(series.x.size(), kMostPlotted);
  EXPECT_GT(series.x.size(), kMostPlotted / 3);
  EXPECT_TRUE(std::is_sorted(series.x.begin(), series.x.end()));
  const auto [low, high] = std::minmax_element(series.y.begin(), series.y.end());
  EXPECT_EQ(*low, -100.0);
  EXPECT_EQ(*high, 100.0);
  EXPECT_EQ(series.x[static_cast<std::size_t>(high - series.y.begin())], double{kSpike});
  EXPECT_EQ(series.x[static_cast<std::size_t>(low - series.y.begin())], double{kDip});
}

TEST(ThinnedSeries, LeavesALongGapOpenAndFillsNone) {
  constexpr std::size_t kCount = 100'000;
  const PlotSeries series =
      series_of(kCount, [](std::size_t i) { return i > 40'000 && i < 60'000 ? kNan : 1.0; });
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const bool inside = series.x[i] > 40'100.0 && series.x[i] < 59'900.0;
    const bool outside = series.x[i] <= 40'000.0 || series.x[i] >= 60'000.0;
    EXPECT_FALSE(inside && !std::isnan(series.y[i])) << series.x[i];
    EXPECT_FALSE(outside && series.y[i] != 1.0) << series.x[i];
  }
}

TEST(ThinnedSeries, PlansTakeEveryPointUntilTheyAreTooMany) {
  EXPECT_EQ(plan_stride(0), 1U);
  EXPECT_EQ(plan_stride(kMostPlotted), 1U);
  EXPECT_EQ(plan_stride(kMostPlotted + 1), 2U);
  EXPECT_EQ(plan_stride(100 * kMostPlotted), 100U);
}

}  // namespace
}  // namespace oneac
