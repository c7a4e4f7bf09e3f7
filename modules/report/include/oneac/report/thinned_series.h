#pragma once

#include "oneac/report/plot.h"

#include <cstddef>

namespace oneac {

/// Points in a row of which a plot of half a thousand pixels needs no more. What grows with a drive
/// is drawn by so many.
inline constexpr std::size_t kMostPlotted = 12'000;

/// Fills a series that grows with a drive: as it is up to kMostPlotted points, of more each bundle
/// of neighbours by its lowest and its highest, in their order. A bundle without a finite value
/// leaves a gap.
class ThinnedSeries {
 public:
  /// @param expected  points that will be added, about
  ThinnedSeries(PlotSeries& series, std::size_t expected);

  void add(double x, double y);
  /// After the last point.
  void flush();

 private:
  struct Point {
    double x = 0.0, y = 0.0;
  };
  void put(const Point& point);

  PlotSeries& series_;
  std::size_t bundle_;     ///< points in each
  std::size_t count_ = 0;  ///< in this one
  Point low_, high_;       ///< of its finite ones; before there is one, any
};

/// Every so manyth of a way seen from above and its last point, at most kMostPlotted and one; which
/// of `count` points those are: i for i < count, i += stride.
[[nodiscard]] std::size_t plan_stride(std::size_t count);

}  // namespace oneac
