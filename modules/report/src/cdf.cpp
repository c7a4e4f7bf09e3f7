#include "oneac/report/cdf.h"

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

constexpr int kSamples = 240;                             // points of a curve: about two pixels
constexpr double kFirstDecade = -4.0, kLastDecade = 7.0;  // what an axis may show at most

struct Decades {
  double low = 0.0, high = 1.0;
};

/// log10 of the finite values, sorted.
std::vector<double> decades_of(const std::vector<double>& values) {
  std::vector<double> decades;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    decades.push_back(value > 0.0 ? std::log10(value) : kFirstDecade);
  }
  std::sort(decades.begin(), decades.end());
  return decades;
}

Decades span_of(const std::vector<Sample>& samples) {
  std::vector<double> all;
  for (const Sample& sample : samples) {
    std::copy_if(sample.values.begin(), sample.values.end(), std::back_inserter(all),
                 [](double value) { return value > 0.0; });
  }
  all = decades_of(all);
  if (all.empty()) return {};
  const auto rank = [&](double share) {
    return all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1))];
  };
  const Decades span{std::max(std::floor(rank(0.01)), kFirstDecade),
                     std::min(std::ceil(rank(0.995)), kLastDecade)};
  return {span.low, std::max(span.high, span.low + 1.0)};
}

PlotSeries curve_of(const Sample& sample, const Decades& span) {
  PlotSeries curve{sample.label, {}, {}, Pen::kLine};
  const std::vector<double> decades = decades_of(sample.values);
  const double count = static_cast<double>(sample.values.size());
  for (int i = 0; i <= kSamples && count > 0.0; ++i) {
    curve.x.push_back(span.low + (span.high - span.low) * i / kSamples);
    const auto below = std::upper_bound(decades.begin(), decades.end(), curve.x.back());
    curve.y.push_back(static_cast<double>(below - decades.begin()) / count);
  }
  return curve;
}

bool lie_on_each_other(const PlotSeries& a, const PlotSeries& b, double tolerance) {
  return !a.y.empty() &&
         std::equal(a.y.begin(), a.y.end(), b.y.begin(), b.y.end(),
                    [&](double p, double q) { return std::abs(p - q) <= tolerance; });
}

}  // namespace

Plot cdf_plot(const std::string& title, const std::string& x_label,
              const std::vector<Sample>& samples) {
  Plot plot{title, x_label, "share of the estimates", {}, true, Axes::kDecades};
  const Decades span = span_of(samples);
  for (const Sample& sample : samples) plot.series.push_back(curve_of(sample, span));
  return plot;
}

std::vector<std::vector<std::string>> coinciding(const Plot& plot, double tolerance) {
  std::vector<std::vector<std::string>> groups;
  std::vector<bool> told(plot.series.size(), false);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    if (told[i]) continue;
    std::vector<std::string> group = {plot.series[i].label};
    for (std::size_t k = i + 1; k < plot.series.size(); ++k) {
      if (told[k] || !lie_on_each_other(plot.series[i], plot.series[k], tolerance)) continue;
      told[k] = true;
      group.push_back(plot.series[k].label);
    }
    if (group.size() > 1) groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace oneac
