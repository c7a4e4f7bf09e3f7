#include "oneac/report/thinned_series.h"

#include <algorithm>
#include <cmath>

namespace oneac {

ThinnedSeries::ThinnedSeries(PlotSeries& series, std::size_t expected)
    : series_(series),
      bundle_(expected <= kMostPlotted ? 1 : (2 * expected + kMostPlotted - 1) / kMostPlotted) {}

void ThinnedSeries::add(double x, double y) {
  const Point point{x, y};
  const bool first = count_ == 0 || !std::isfinite(low_.y);
  if (first || y < low_.y) low_ = point;
  if (first || y > high_.y) high_ = point;
  if (++count_ == bundle_) flush();
}

void ThinnedSeries::flush() {
  if (count_ == 0) return;
  count_ = 0;
  put(low_.x <= high_.x ? low_ : high_);
  if (low_.x != high_.x) put(low_.x <= high_.x ? high_ : low_);
}

void ThinnedSeries::put(const Point& point) {
  series_.x.push_back(point.x);
  series_.y.push_back(point.y);
}

std::size_t plan_stride(std::size_t count) {
  return std::max<std::size_t>((count + kMostPlotted - 1) / kMostPlotted, 1);
}

}  // namespace oneac
