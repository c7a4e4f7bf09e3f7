#pragma once

#include "oneac/robust/motion_evidence.h"
#include "oneac/robust/robust_result.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

#include <optional>

namespace oneac {

/// What the tests go by; lengths in normalised image units.
struct DegeneracyBounds {
  double threshold;       ///< of an inlier
  double standing_shift;  ///< median shift beside a rotation that is noise
  Eigen::Matrix3d R_level_cam = Eigen::Matrix3d::Identity();  ///< removes the camera's tilt
  MotionPrior prior;                                          ///< what is known beforehand
};

/// The answer of a camera that stood, R = I (kNoMotion), where hardly anything moved and what did
/// is no evidence of a translation (motion_evidence.h). Empty otherwise.
/// @pre acs is not empty and finite
[[nodiscard]] std::optional<RobustResult> find_standing(AcSpan acs, const DegeneracyBounds& bounds);

/// Whether the camera stayed where it was.
struct MotionDecision {
  std::optional<RobustResult> resting;     ///< kNoMotion or kPureRotation, t = 0, with its evidence
  RelativePose moving;                     ///< else the motion to go on with, |t| = 1
  std::optional<MotionEvidence> evidence;  ///< of either, where it was looked into
};

/// Weighs a candidate, unit t of either sign, against a camera that stood, turned or rocked without
/// travelling. Looked into only where a rotation comes near to explaining the points, or many near
/// ones keep their place.
/// @pre acs is not empty and finite
[[nodiscard]] MotionDecision resting_or_moving(AcSpan acs, const RelativePose& candidate,
                                               const DegeneracyBounds& bounds);

/// Completes a candidate, unit t of either sign: polished in double precision, inliers, cost, sign
/// by cheirality, covariance. Status and statistics are left as they are.
void complete_result(const RelativePose& candidate, AcSpan acs, double threshold,
                     RobustResult& result);

/// Sets kOnePlane when all inliers of an ok result lie on a plane, and takes that of the two poses
/// it admits which is nearer to a vehicle's planar motion.
void resolve_one_plane(AcSpan acs, const Eigen::Matrix3d& R_level_cam, double threshold,
                       RobustResult& result);

}  // namespace oneac
