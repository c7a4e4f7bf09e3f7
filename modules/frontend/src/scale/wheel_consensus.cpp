#include "oneac/frontend/wheel_consensus.h"

#include "oneac/base/median.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace oneac {
namespace {

constexpr std::size_t kFewest = 8;    // measurements that can be of one opinion
constexpr std::size_t kOutliers = 4;  // besides, at most: one slip while the car brakes ...
constexpr std::size_t kFitting = 4;   // ... and so many that fit to each of them
constexpr double kGate = 3.0;         // [σ]
// [-] 1σ of the map's own steps, beside that of the measurement: landmarks hand lengths on.
constexpr double kMapSigma = 0.02;

}  // namespace

double WheelConsensus::median() const {
  std::vector<double> logs;
  for (const Told& one : told_) logs.push_back(one.log_ratio);
  return upper_median(std::move(logs));
}

WheelConsensus::Verdict WheelConsensus::add(double log_ratio, double sigma) {
  told_.push_back({log_ratio, sigma, way_});
  // The oldest that is kept is the one with which they cover the way.
  while (told_.size() > 2 && way_ - told_[1].way >= kWay) told_.pop_front();
  Verdict verdict;
  verdict.median = median();
  const auto fits = [&](const Told& one) {
    const double gate = kGate * std::hypot(one.sigma, kMapSigma);
    return std::abs(one.log_ratio - verdict.median) <= gate;
  };
  const auto fitting = static_cast<std::size_t>(std::count_if(told_.begin(), told_.end(), fits));
  verdict.fits = fits(told_.back());
  verdict.agreed = way_ - told_.front().way >= kWay && fitting >= kFewest &&
                   told_.size() - fitting <= std::min(kOutliers, fitting / kFitting);
  return verdict;
}

void WheelConsensus::rescale(double log_factor) {
  for (Told& one : told_) one.log_ratio -= log_factor;
}

}  // namespace oneac
