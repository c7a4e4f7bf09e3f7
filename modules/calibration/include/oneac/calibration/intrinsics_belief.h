#pragma once

#include "oneac/calibration/intrinsics_measurement.h"

#include <cstddef>
#include <vector>

namespace oneac {

/// A camera with what is known of it.
struct IntrinsicsEstimate {
  PinholeCamera camera;
  IntrinsicsVector change = IntrinsicsVector::Zero();  ///< against the camera before
  IntrinsicsMatrix covariance = IntrinsicsMatrix::Zero();
  IntrinsicsVector drive_sigma = IntrinsicsVector::Zero();  ///< 1σ by the drive alone; may be huge
  std::size_t windows = 0;

  [[nodiscard]] double sigma(Intrinsic which) const;
};

/// What the windows of a drive say together. Information adds up; what it does not know is left to
/// the prior.
///
/// Its covariance is the larger of two, unknown by unknown: that of the residuals, times
/// kCorrelation since the errors of a track are not independent, and the cluster-robust one
/// (sandwich) of what the windows say against each other, Λ⁻¹ (Σ g gᵀ) Λ⁻¹ · W / (W − 1) with the
/// scores g of W windows [Liang and Zeger 1986], which also knows what the model leaves out, times
/// Student's factor for few of them. One window alone moves nothing: its scatter is not known.
/// What another sensor says of the focal length comes beside them, with its own σ, and counts in
/// the scatter.
class IntrinsicsBelief {
 public:
  static constexpr std::size_t kFewestWindows = 2;

  IntrinsicsBelief(const PinholeCamera& from, const IntrinsicsPrior& prior);

  void add(const IntrinsicsMeasurement& measured);
  /// The focal length by turns that another sensor measured, independent of the windows.
  /// @param log_focal  ln(f / f₀)
  /// @param sigma      1σ of it, all that is known to be wrong included
  /// @throws std::invalid_argument unless both are finite and sigma is above 0
  void add_focal(double log_focal, double sigma);
  [[nodiscard]] IntrinsicsEstimate estimate() const;
  /// 1σ before the drive.
  [[nodiscard]] double prior_sigma(Intrinsic which) const;

 private:
  [[nodiscard]] std::vector<IntrinsicsMeasurement> counted() const;

  PinholeCamera from_;
  IntrinsicsMatrix prior_;
  std::vector<IntrinsicsMeasurement> measured_;
  std::vector<IntrinsicsMeasurement> told_;  ///< by other sensors
};

}  // namespace oneac
