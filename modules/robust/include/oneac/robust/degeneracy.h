#pragma once

#include "oneac/robust/robust_result.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

#include <optional>

namespace oneac {

/// Bounds of the tests, in normalised image units.
struct DegeneracyBounds {
  double threshold;       ///< of an inlier
  double standing_shift;  ///< median shift beside a rotation that is noise
};

/// The answer of a camera that stood, R = I (kNoMotion). Empty when the points moved.
/// @pre acs is not empty and finite
[[nodiscard]] std::optional<RobustResult> standing(AcSpan acs, const DegeneracyBounds& bounds);

/// The answer of a camera that turned or rocked without travelling, t = 0 (kPureRotation), found
/// from a rotation near the true one. Empty when a rotation does not explain the points.
/// @pre acs is not empty and finite
[[nodiscard]] std::optional<RobustResult> turning(AcSpan acs, const Eigen::Matrix3d& R_start,
                                                  const DegeneracyBounds& bounds);

/// Completes a candidate, unit t of either sign: polished in double precision, inliers, cost, sign
/// by cheirality, covariance. Status and statistics are left as they are.
void conclude(const RelativePose& candidate, AcSpan acs, double threshold, RobustResult& result);

/// Sets kOnePlane when all inliers of an ok result lie on a plane, and takes that of the two poses
/// it admits which is nearer to a vehicle's planar motion.
void settle_one_plane(AcSpan acs, const Eigen::Matrix3d& R_level_cam, double threshold,
                      RobustResult& result);

}  // namespace oneac
