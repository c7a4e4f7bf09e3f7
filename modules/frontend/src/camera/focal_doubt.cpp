#include "camera/focal_doubt.h"

#include <cmath>

namespace oneac {
namespace {

// [-] share of calibrations that are poor, and 1σ of ln f among them: images resized, another lens,
// a guess. Good ones are better than any bend.
constexpr double kPoor = 0.1;
constexpr double kPoorSigma = 0.05;

/// ln of the normal density without its constant.
double log_density(double x, double variance) {
  return -0.5 * (x * x / variance + std::log(variance));
}

}  // namespace

double focal_doubt(double log_focal, double sigma) {
  if (!std::isfinite(log_focal) || !(sigma > 0.0) || !std::isfinite(sigma)) return 0.0;
  const double told = sigma * sigma, poor = kPoorSigma * kPoorSigma;
  const double odds = (1.0 - kPoor) / kPoor *
                      std::exp(log_density(log_focal, told) - log_density(log_focal, told + poor));
  const double mean = log_focal * poor / (poor + told);
  const double variance = poor * told / (poor + told);
  return std::sqrt((mean * mean + variance) / (1.0 + odds));
}

}  // namespace oneac
