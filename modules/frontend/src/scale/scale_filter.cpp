#include "oneac/frontend/scale_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oneac {
namespace {

// So many measurements in a row that are not believed, over so many stretches of road: then it is
// the map that is wrong. One kerb or footway is one measurement, however often it is seen.
constexpr int kPatience = 5;
constexpr double kStretches = 2.0;
// [m] of way over which the road's error changes. Most weight has the road 5 to 15 m ahead, so a
// stretch of it stays in view for 10 m, and halfway half of what is seen is new.
constexpr double kStretch = 5.0;
// [1/√rad] A bend has the scale handed on, from view to view, by landmarks that came into it a few
// steps ago: 5 to 10 % of it were lost in 50° of real ones.
constexpr double kTurnDrift = 0.06;

double lasting_sigma(const ScaleOptions& options) {
  if (options.source == "wheels") return options.wheel_uncertainty;
  return options.source == "height" ? options.road_uncertainty : 0.0;
}

}  // namespace

ScaleFilter::ScaleFilter(const ScaleOptions& options)
    : options_(options),
      lasting_variance_(lasting_sigma(options) * lasting_sigma(options)),
      by_wheels_(options.source == "wheels") {}

double ScaleFilter::drift(double way, double carried_variance, double turn) {
  const double before = variance_;
  refused_way_ += std::abs(way);
  wheels_.travel(std::abs(way));
  variance_ += options_.map_drift * options_.map_drift + kStepsOfALandmark * carried_variance +
               kTurnDrift * kTurnDrift * std::abs(turn);
  const double kept = by_wheels_ ? 1.0 : std::exp(-std::abs(way) / kStretch);
  error_ *= kept;
  error_variance_ = lasting_variance_ + kept * kept * (error_variance_ - lasting_variance_);
  covariance_ *= kept;
  return known_ ? before / variance_ : 1.0;
}

void ScaleFilter::lose() {
  known_ = false;
  doubted_ = false;
  wheels_.forget();
}

double ScaleFilter::start(double ratio, double noise) {
  known_ = true;
  refused_ = 0;
  error_ = 0.0;
  error_variance_ = lasting_variance_;
  variance_ = noise + lasting_variance_;
  covariance_ = -lasting_variance_;  // what is wrong with the measurement is now in the map
  return ratio;
}

double ScaleFilter::correct(double ratio, double sigma) {
  began_anew_ = false;
  if (!(ratio > 0.0) || !std::isfinite(ratio) || !(sigma > 0.0)) return 1.0;
  if (by_wheels_) return correct_by_wheels(std::log(ratio), sigma);
  const double noise = sigma * sigma;
  if (!known_) return start(ratio, noise);
  // z = state + error + noise; the state is zero.
  const double innovation = std::log(ratio) - error_;
  if (!is_likely(innovation, noise)) {
    if (++refused_ == 1) refused_way_ = 0.0;
    if (refused_ < kPatience || refused_way_ < kStretches * kStretch) return 1.0;
    began_anew_ = true;
    return start(ratio, noise);
  }
  refused_ = 0;
  return update(innovation, noise * surprise(innovation, noise));
}

/// How many times the noise of a measurement that surprises counts: its tails are those of traffic
/// and kerbs, longer than Gauss's, so that the farther off it is, the less of it is believed.
double ScaleFilter::surprise(double innovation, double noise) const {
  constexpr double kUsual = 2.0;  // [σ]
  const double total = variance_of_innovation(noise);
  return std::max(1.0, innovation * innovation / (kUsual * kUsual * total));
}

double ScaleFilter::variance_of_innovation(double noise) const {
  return (variance_ + covariance_) + (error_variance_ + covariance_) + noise;
}

double ScaleFilter::correct_by_wheels(double log_ratio, double sigma) {
  const double noise = sigma * sigma;
  const WheelConsensus::Verdict told = wheels_.add(log_ratio, sigma);
  double factor = 1.0;
  if (!known_) {
    factor = std::exp(told.median);
    if (told.agreed) start(factor, noise);
  } else {
    const bool likely = is_likely(told.median - error_, noise);
    doubted_ = !told.agreed || !likely;
    if (told.fits && likely) factor = update(log_ratio - error_, noise);
  }
  wheels_.rescale(std::log(factor));
  return factor;
}

bool ScaleFilter::is_likely(double innovation, double noise) const {
  return std::abs(innovation) <= options_.outlier_sigmas * std::sqrt(variance_of_innovation(noise));
}

double ScaleFilter::update(double innovation, double noise) {
  const double state_share = variance_ + covariance_;
  const double error_share = error_variance_ + covariance_;
  const double total = state_share + error_share + noise;
  error_ += error_share / total * innovation;
  variance_ -= state_share * state_share / total;
  covariance_ -= state_share * error_share / total;
  error_variance_ -= error_share * error_share / total;
  return std::exp(state_share / total * innovation);
}

double ScaleFilter::uncertainty() const {
  return known_ ? std::sqrt(variance_) : std::numeric_limits<double>::infinity();
}

}  // namespace oneac
