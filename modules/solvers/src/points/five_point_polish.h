#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

#include <optional>

namespace oneac::internal {

/// A motion of an essential matrix, up to the twist and the sign of t, |t| = 1: E = ±[t]× R. No
/// SVD; errors of E come out of first order; none where E is too far from an essential matrix to
/// have a rotation. Source: Horn, Recovering baseline and orientation from essential matrix, 1990.
[[nodiscard]] std::optional<RelativePose> motion_near(const Eigen::Matrix3d& E);

/// Newton on the five epipolar equations over the five degrees of freedom of (R, t/|t|): quadratic
/// but for double roots, and [t]× R is essential by construction. False when it ends nowhere.
[[nodiscard]] bool polish_on_five_points(AcSpan points, RelativePose& T);

}  // namespace oneac::internal
