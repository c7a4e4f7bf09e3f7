#include "oneac/frontend/scale_filter.h"

#include <cmath>
#include <limits>
#include <utility>

namespace oneac {
namespace {

// So many measurements in a row that are not believed: then it is the map that is wrong.
constexpr int kPatience = 5;

}  // namespace

double ScaleFilter::drift() {
  const double before =
      std::exchange(variance_, variance_ + options_.map_drift * options_.map_drift);
  return known_ ? before / variance_ : 1.0;
}

void ScaleFilter::lose() {
  known_ = false;
}

double ScaleFilter::correct(double ratio, double sigma) {
  if (!(ratio > 0.0) || !std::isfinite(ratio) || !(sigma > 0.0)) return 1.0;
  const double innovation = std::log(ratio);
  const double noise = sigma * sigma;
  if (!known_) {
    known_ = true;
    variance_ = noise;
    refused_ = 0;
    return ratio;
  }
  const double total = variance_ + noise;
  if (std::abs(innovation) > options_.outlier_sigmas * std::sqrt(total)) {
    if (++refused_ < kPatience) return 1.0;
    lose();
    return correct(ratio, sigma);
  }
  refused_ = 0;
  const double gain = variance_ / total;
  variance_ *= 1.0 - gain;
  return std::exp(gain * innovation);
}

double ScaleFilter::uncertainty() const {
  return known_ ? std::sqrt(variance_) : std::numeric_limits<double>::infinity();
}

}  // namespace oneac
