#include "oneac/calibration/height_measurement.h"

#include "oneac/base/median.h"
#include "oneac/base/require.h"
#include "oneac/geometry/robust_loss.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oneac {
namespace {

constexpr std::size_t kFewestSpans = 3;
constexpr std::size_t kFewestToJudge = 8;  // spans among which one that is wrong shows
constexpr double kLeastWay = 20.0;         // [m]
constexpr double kCauchy = 2.0;            // [σ]
constexpr double kContradiction = 3.0;     // [σ]
constexpr int kIterations = 10;

void validate(const WaySpan& span) {
  require(std::isfinite(span.by_road) && span.by_road >= 0.0, "way span: by_road", span.by_road,
          "from 0 on");
  require(std::isfinite(span.by_sensor) && span.by_sensor >= 0.0, "way span: by_sensor",
          span.by_sensor, "from 0 on");
  require(std::isfinite(span.sigma) && span.sigma > 0.0, "way span: sigma", span.sigma, "above 0");
}

/// [σ of the span times the scatter]
double residual(const WaySpan& span, double ratio, double scatter) {
  return (span.by_sensor - ratio * span.by_road) / (span.sigma * scatter);
}

/// Of few spans nobody knows which are wrong: two that agree by chance would outvote a third.
double weight(const WaySpan& span, double ratio, double scatter, std::size_t spans) {
  if (spans < kFewestToJudge) return 1.0;
  const double r = residual(span, ratio, scatter);
  return cauchy_weight(r * r, kCauchy * kCauchy);
}

double median_ratio(const std::vector<WaySpan>& spans) {
  std::vector<double> ratios;
  for (const WaySpan& span : spans) {
    if (span.by_road > 0.0) ratios.push_back(span.by_sensor / span.by_road);
  }
  return ratios.empty() ? 0.0 : upper_median(std::move(ratios));
}

/// By how much the spans scatter beyond their σ; at least 1.
double scatter_of(const std::vector<WaySpan>& spans, double ratio) {
  constexpr double kGaussian = 1.4826;
  std::vector<double> sizes;
  double squares = 0.0;
  for (const WaySpan& span : spans) {
    sizes.push_back(std::abs(residual(span, ratio, 1.0)));
    squares += sizes.back() * sizes.back();
  }
  const auto count = static_cast<double>(spans.size());
  const double size = spans.size() < kFewestToJudge ? std::sqrt(squares / (count - 1.0))
                                                    : kGaussian * upper_median(std::move(sizes));
  return std::max(1.0, size);
}

/// In units of the spans' σ and scatter.
struct Sums {
  double information = 0.0;    ///< Σ w x²
  double right = 0.0;          ///< Σ w x y
  std::vector<double> scores;  ///< w r x
};

Sums sums_at(const std::vector<WaySpan>& spans, double ratio, double scatter) {
  Sums sums;
  for (const WaySpan& span : spans) {
    const double w = weight(span, ratio, scatter, spans.size());
    const double x = span.by_road / (span.sigma * scatter);
    sums.information += w * x * x;
    sums.right += w * x * span.by_sensor / (span.sigma * scatter);
    sums.scores.push_back(w * residual(span, ratio, scatter) * x);
  }
  return sums;
}

/// Variance of the sum of the scores, whose errors reach into the next two: receivers filter, and
/// a map goes on [Newey and West 1987].
double variance_of(const std::vector<double>& scores) {
  constexpr std::size_t kReach = 2;
  double alone = 0.0, together = 0.0;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    alone += scores[i] * scores[i];
    for (std::size_t lag = 1; lag <= kReach && lag <= i; ++lag) {
      const double share = 1.0 - static_cast<double>(lag) / (kReach + 1.0);
      together += 2.0 * share * scores[i] * scores[i - lag];
    }
  }
  return alone + std::max(together, 0.0);
}

}  // namespace

std::optional<HeightMeasurement> measure_height_by_ways(const std::vector<WaySpan>& spans) {
  HeightMeasurement result;
  for (const WaySpan& span : spans) {
    validate(span);
    result.way += span.by_sensor;
  }
  result.spans = spans.size();
  if (spans.size() < kFewestSpans || !(result.way >= kLeastWay)) return std::nullopt;
  result.ratio = median_ratio(spans);
  for (int i = 0; i < kIterations; ++i) {
    const Sums sums = sums_at(spans, result.ratio, scatter_of(spans, result.ratio));
    if (!(sums.information > 0.0)) return std::nullopt;
    result.ratio = sums.right / sums.information;
  }
  if (!(result.ratio > 0.0) || !std::isfinite(result.ratio)) return std::nullopt;
  const Sums sums = sums_at(spans, result.ratio, scatter_of(spans, result.ratio));
  const double robust = variance_of(sums.scores) / (sums.information * sums.information);
  // Student's factor, as in IntrinsicsBelief.
  const double few = 1.0 + 1.06 / (static_cast<double>(spans.size()) - 1.0);
  result.sigma = few * std::sqrt(std::max(1.0 / sums.information, robust)) / result.ratio;
  return result;
}

std::optional<HeightMeasurement> height_by_all(const std::vector<HeightMeasurement>& sensors) {
  if (sensors.empty()) return std::nullopt;
  double information = 0.0, sum = 0.0;
  HeightMeasurement all;
  for (const HeightMeasurement& one : sensors) {
    require(one.ratio > 0.0 && std::isfinite(one.ratio), "height: ratio", one.ratio, "above 0");
    require(one.sigma > 0.0 && std::isfinite(one.sigma), "height: sigma", one.sigma, "above 0");
    for (const HeightMeasurement& other : sensors) {
      const double apart = std::abs(std::log(one.ratio / other.ratio));
      if (apart > kContradiction * std::hypot(one.sigma, other.sigma)) return std::nullopt;
    }
    const double w = 1.0 / (one.sigma * one.sigma);
    information += w;
    sum += w * std::log(one.ratio);
    all.way = std::max(all.way, one.way);
    all.spans = std::max(all.spans, one.spans);
  }
  all.ratio = std::exp(sum / information);
  all.sigma = 1.0 / std::sqrt(information);
  return all;
}

}  // namespace oneac
