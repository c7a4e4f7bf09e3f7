#include "oneac/calibration/turn_measurement.h"

#include "oneac/base/median.h"
#include "oneac/base/require.h"
#include "oneac/geometry/robust_loss.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <utility>

namespace oneac {
namespace {

constexpr std::size_t kFewestSpans = 4;
constexpr double kFewestBends = 1.5;  // two, the smaller of which is half the larger
constexpr double kLeastTurn = 0.35;   // [rad] root of the squares of all: 20°
constexpr double kCauchy = 2.0;       // [σ]
constexpr int kIterations = 10;
constexpr double kUnknowns = 2.0;

/// ψ_sensor − ψ_images = x · (scale, bias) over the spans.
struct Fit {
  Eigen::Vector2d found = Eigen::Vector2d::Zero();
  Eigen::Matrix2d inverse = Eigen::Matrix2d::Zero();  ///< of XᵀWX, prior included
  double scatter = 0.0;                               ///< [rad]
};

Eigen::Vector2d row_of(const TurnSpan& span) {
  return {span.by_images, span.duration};
}

double residual(const TurnSpan& span, const Eigen::Vector2d& found) {
  return span.by_sensor - span.by_images - row_of(span).dot(found);
}

double weight(const TurnSpan& span, const Fit& fit) {
  const double r = residual(span, fit.found) / fit.scatter;
  return cauchy_weight(r * r, kCauchy * kCauchy);
}

/// Robust 1σ of a span with what the unknowns have fitted away.
double scatter_of(const std::vector<TurnSpan>& spans, const Fit& fit, double least) {
  constexpr double kGaussian = 1.4826;
  std::vector<double> sizes;
  for (const TurnSpan& span : spans) sizes.push_back(std::abs(residual(span, fit.found)));
  const auto count = static_cast<double>(spans.size());
  return std::max(
      least, kGaussian * upper_median(std::move(sizes)) * std::sqrt(count / (count - kUnknowns)));
}

Fit solved(const std::vector<TurnSpan>& spans, const Fit& before, const TurnSensor& sensor) {
  constexpr double kHeld = 1e-9;  // [rad/s] a bias that is none
  const double bias = before.scatter / std::max(sensor.bias_sigma, kHeld);
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  A(1, 1) = bias * bias;
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  for (const TurnSpan& span : spans) {
    const double w = weight(span, before);
    A += w * row_of(span) * row_of(span).transpose();
    b += w * (span.by_sensor - span.by_images) * row_of(span);
  }
  Fit fit = before;
  fit.inverse = A.ldlt().solve(Eigen::Matrix2d::Identity());
  fit.found = fit.inverse * b;
  fit.scatter = scatter_of(spans, fit, sensor.span_sigma);
  return fit;
}

/// 1σ of a span by all spans: the median of few is too small too often to make a σ of it.
double final_scatter(const std::vector<TurnSpan>& spans, const Fit& fit) {
  constexpr double kGaussian = 0.63;  // mean of w r² at kCauchy for normal errors of 1σ
  double sum = 0.0;
  for (const TurnSpan& span : spans) {
    const double r = residual(span, fit.found);
    sum += weight(span, fit) * r * r;
  }
  const double freedom = static_cast<double>(spans.size()) - kUnknowns;
  return std::max(fit.scatter, std::sqrt(sum / (kGaussian * freedom)));
}

/// Variance of the scale by the residuals that the spans really have.
double robust_variance(const std::vector<TurnSpan>& spans, const Fit& fit) {
  Eigen::Matrix2d middle = Eigen::Matrix2d::Zero();
  for (const TurnSpan& span : spans) {
    const double score = weight(span, fit) * residual(span, fit.found);
    middle += score * score * row_of(span) * row_of(span).transpose();
  }
  return (fit.inverse * middle * fit.inverse)(0, 0);
}

struct Spread {
  double squares = 0.0, bends = 0.0;
};

Spread spread_of(const std::vector<TurnSpan>& spans) {
  double squares = 0.0, fourths = 0.0;
  for (const TurnSpan& span : spans) {
    const double square = span.by_images * span.by_images;
    squares += square;
    fourths += square * square;
  }
  return {squares, fourths > 0.0 ? squares * squares / fourths : 0.0};
}

}  // namespace

void TurnSensor::validate() const {
  require(span_sigma > 0.0 && span_sigma <= 1.0, "turn sensor: span_sigma", span_sigma,
          "above 0, up to 1");
  require(scale_sigma >= 0.0 && scale_sigma <= 1.0, "turn sensor: scale_sigma", scale_sigma,
          "from 0 to 1");
  require(bias_sigma >= 0.0 && bias_sigma <= 1.0, "turn sensor: bias_sigma", bias_sigma,
          "from 0 to 1");
}

std::optional<TurnMeasurement> measure_focal_by_turns(const std::vector<TurnSpan>& spans,
                                                      const TurnSensor& sensor) {
  sensor.validate();
  const Spread spread = spread_of(spans);
  if (spans.size() < kFewestSpans || !(spread.bends >= kFewestBends)) return std::nullopt;
  if (!(spread.squares >= kLeastTurn * kLeastTurn)) return std::nullopt;
  Fit fit;
  fit.scatter = scatter_of(spans, fit, sensor.span_sigma);
  for (int i = 0; i < kIterations; ++i) fit = solved(spans, fit, sensor);
  constexpr double kLargest = 0.9;  // a sensor of another vehicle, or upside down
  if (!fit.found.allFinite() || !(std::abs(fit.found[0]) < kLargest)) return std::nullopt;
  TurnMeasurement result;
  const double scale = 1.0 + fit.found[0];
  result.scatter = final_scatter(spans, fit);
  const double plain = result.scatter * result.scatter * fit.inverse(0, 0);
  // Student's factor, as in IntrinsicsBelief: few bends tell little of their scatter.
  const double few = 1.0 + 1.06 / (spread.bends - 1.0);
  const double variance =
      few * few * std::max(plain, robust_variance(spans, fit)) / (scale * scale);
  result.log_focal = -std::log(scale);
  result.sigma = std::sqrt(variance + sensor.scale_sigma * sensor.scale_sigma);
  result.bias = fit.found[1];
  result.bends = spread.bends;
  return result;
}

}  // namespace oneac
