#pragma once

#include "oneac/solvers/planar_pose.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

#include <optional>

namespace oneac::internal {

/// What of the correspondences a plane-free solver uses.
enum class EpipolarRows { kAffine, kPointsOnly };

/// (E12, E21, E23, E32) of a planar E, or of the planar F of a wrong focal length, up to scale:
/// exactly from one correspondence, the signed minors of its three equations; empty when two of
/// them are parallel.
[[nodiscard]] std::optional<Eigen::Vector4d> entries_of(const AffineCorrespondence& ac);
/// The same from those that take part in algebraic least squares; empty when not determined.
[[nodiscard]] std::optional<Eigen::Vector4d> entries_of(AcSpan acs, const double* weights);

/// t (|t| = 1) and α from e = (E12, E21, E23, E32) of a planar E; empty when there is no
/// translation.
[[nodiscard]] std::optional<PlanarPose> pose_from_entries(const Eigen::Vector4d& e);

/// The sign of t for which most points lie before both cameras; empty when none do for either.
[[nodiscard]] SolutionSet<PlanarPose, 1> with_sign(const std::optional<PlanarPose>& pose,
                                                   AcSpan acs, const double* weights,
                                                   EpipolarRows rows);

/// Epipolar row in e: u y, v x, v, y.
[[nodiscard]] inline Eigen::Vector4d epipolar_row(const AffineCorrespondence& ac) {
  return {ac.x2.x() * ac.x1.y(), ac.x2.y() * ac.x1.x(), ac.x2.y(), ac.x1.y()};
}

}  // namespace oneac::internal
