#include "oneac/calibration/intrinsics_belief.h"

#include "oneac/base/require.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace oneac {
namespace {

// [-] 1σ of a drive over that of independent residuals: a tracker's errors stay along a track.
// Found on simulated bends, where windows scatter 3 to 4 times as far
// (docs/benchmarks/calibration.md).
constexpr double kCorrelation = 4.0;
// [-] information that makes no matrix singular.
constexpr double kNothing = 1e-9;

/// What a scatter of few windows is worth less: Student's 90 % quantile over the normal one.
double student_factor(std::size_t windows) {
  constexpr double kFactors[] = {3.84, 1.78, 1.43, 1.30, 1.23, 1.18};  // of 2 to 7 windows
  if (windows < 2) return kFactors[0];
  if (windows - 2 < std::size(kFactors)) return kFactors[windows - 2];
  return 1.0 + 1.06 / static_cast<double>(windows - 1);
}

/// Λ⁻¹ (Σ g gᵀ) Λ⁻¹ · W / (W − 1); zero for less than two.
IntrinsicsMatrix scatter_of(const std::vector<IntrinsicsMeasurement>& told,
                            const IntrinsicsMatrix& inverse, const IntrinsicsVector& change) {
  if (told.size() < 2) return IntrinsicsMatrix::Zero();
  IntrinsicsMatrix sum = IntrinsicsMatrix::Zero();
  for (const IntrinsicsMeasurement& m : told) {
    const IntrinsicsVector score = m.pull - m.information * change;
    sum += score * score.transpose();
  }
  const double count = static_cast<double>(told.size());
  return inverse * sum * inverse * (count / (count - 1.0));
}

/// A window with what its sightings are worth, since their errors are not independent.
IntrinsicsMeasurement weighed(IntrinsicsMeasurement window) {
  constexpr double kShare = 1.0 / (kCorrelation * kCorrelation);
  window.information *= kShare;
  window.pull *= kShare;
  return window;
}

}  // namespace

double IntrinsicsEstimate::sigma(Intrinsic which) const {
  return std::sqrt(std::max(covariance(which, which), 0.0));
}

IntrinsicsBelief::IntrinsicsBelief(const PinholeCamera& from, const IntrinsicsPrior& prior)
    : from_(from), prior_(prior.information()) {
  from.validate();
  prior.validate();
}

void IntrinsicsBelief::add(const IntrinsicsMeasurement& measured) {
  measured_.push_back(measured);
}

void IntrinsicsBelief::add_focal(double log_focal, double sigma) {
  require(std::isfinite(log_focal), "add_focal: log_focal", log_focal, "finite");
  require(sigma > 0.0 && std::isfinite(sigma), "add_focal: sigma", sigma, "above 0");
  IntrinsicsMeasurement told;
  told.change.setZero();
  told.change[kFocal] = log_focal;
  told.information.setZero();
  told.information(kFocal, kFocal) = 1.0 / (sigma * sigma);
  told.pull = told.information * told.change;
  told_.push_back(told);
}

double IntrinsicsBelief::prior_sigma(Intrinsic which) const {
  return 1.0 / std::sqrt(prior_(which, which));
}

/// All that counts. What one window says nothing confirms: it may be full of traffic.
std::vector<IntrinsicsMeasurement> IntrinsicsBelief::counted() const {
  std::vector<IntrinsicsMeasurement> counted;
  if (measured_.size() >= kFewestWindows) {
    for (const IntrinsicsMeasurement& window : measured_) counted.push_back(weighed(window));
  }
  counted.insert(counted.end(), told_.begin(), told_.end());
  return counted;
}

IntrinsicsEstimate IntrinsicsBelief::estimate() const {
  const std::vector<IntrinsicsMeasurement> told = counted();
  IntrinsicsMatrix information = IntrinsicsMatrix::Zero();
  IntrinsicsVector pull = IntrinsicsVector::Zero();
  for (const IntrinsicsMeasurement& m : told) {
    information += m.information;
    pull += m.pull;
  }
  IntrinsicsEstimate result;
  result.windows = measured_.size();
  result.covariance = (information + prior_).llt().solve(IntrinsicsMatrix::Identity());
  result.change = result.covariance * pull;
  result.camera = changed(from_, result.change);
  const IntrinsicsMatrix nothing = kNothing * IntrinsicsMatrix::Identity();
  result.drive_sigma = (information + nothing)
                           .ldlt()
                           .solve(IntrinsicsMatrix::Identity())
                           .diagonal()
                           .cwiseMax(0.0)
                           .cwiseSqrt();
  if (told.size() < 2) return result;
  const IntrinsicsMatrix scatter = scatter_of(told, result.covariance, result.change);
  const double few = student_factor(told.size());
  for (int i = 0; i < kIntrinsics; ++i) {
    const double more =
        std::sqrt(std::max(few * few * scatter(i, i) / result.covariance(i, i), 1.0));
    result.covariance.row(i) *= more;
    result.covariance.col(i) *= more;
  }
  return result;
}

}  // namespace oneac
