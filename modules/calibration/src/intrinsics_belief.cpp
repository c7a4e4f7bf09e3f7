#include "oneac/calibration/intrinsics_belief.h"

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

/// Λ⁻¹ (Σ g gᵀ) Λ⁻¹ · W / (W − 1); zero for less than two windows.
IntrinsicsMatrix scatter_of(const std::vector<IntrinsicsMeasurement>& measured,
                            const IntrinsicsMatrix& inverse, const IntrinsicsVector& change) {
  if (measured.size() < 2) return IntrinsicsMatrix::Zero();
  IntrinsicsMatrix sum = IntrinsicsMatrix::Zero();
  for (const IntrinsicsMeasurement& m : measured) {
    const IntrinsicsVector score = m.pull - m.information * change;
    sum += score * score.transpose();
  }
  const double windows = static_cast<double>(measured.size());
  return inverse * sum * inverse * (windows / (windows - 1.0));
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

IntrinsicsEstimate IntrinsicsBelief::estimate() const {
  constexpr double kShare = 1.0 / (kCorrelation * kCorrelation);
  // What one window says nothing confirms: it may be full of traffic.
  const bool confirmed = measured_.size() >= kFewestWindows;
  IntrinsicsMatrix information = IntrinsicsMatrix::Zero();
  IntrinsicsVector pull = IntrinsicsVector::Zero();
  for (const IntrinsicsMeasurement& m : measured_) {
    if (!confirmed) break;
    information += kShare * m.information;
    pull += kShare * m.pull;
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
  if (!confirmed) return result;
  const IntrinsicsMatrix scatter =
      scatter_of(measured_, result.covariance, result.change) * (kShare * kShare);
  const double few = student_factor(measured_.size());
  for (int i = 0; i < kIntrinsics; ++i) {
    const double more =
        std::sqrt(std::max(few * few * scatter(i, i) / result.covariance(i, i), 1.0));
    result.covariance.row(i) *= more;
    result.covariance.col(i) *= more;
  }
  return result;
}

}  // namespace oneac
