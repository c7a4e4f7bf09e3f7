#pragma once

#include "oneac/solvers/span.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace oneac {

/// A rotation that maps x1 to x2 when the camera does not translate.
struct RotationFit {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of w, R = exp([w]×) R̂ [rad²]
};

/// The rotation that best maps x1 to x2 when the camera does not translate, x2 ≈ π(R x1), from one
/// within a few thresholds of the true one.
///
/// Gauss–Newton with a Geman–McClure loss, its scale lowered to `threshold`.
/// @param threshold  [-] normalised image units
[[nodiscard]] RotationFit refine_rotation(const Eigen::Matrix3d& start, AcSpan acs,
                                          double threshold);

/// |x2 − π(R x1)| of each correspondence [-]; infinity for a point that R turns behind the camera.
[[nodiscard]] std::vector<double> rotation_transfer_errors(const Eigen::Matrix3d& R, AcSpan acs);

/// The median of rotation_transfer_errors over at most `looked_at` correspondences, evenly spaced.
/// @pre acs is not empty, looked_at > 0
[[nodiscard]] double median_transfer_error(const Eigen::Matrix3d& R, AcSpan acs,
                                           std::size_t looked_at);

}  // namespace oneac
