#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

namespace oneac {

/// Essential matrix from eight or more points, linear.
///
/// Model: x2ᵀ E x1 = 0, one row per point; Hartley and Zisserman, algorithm 11.1, with the singular
/// values set to (1, 1, 0). Eight points are solved exactly, more in algebraic least squares after
/// Hartley's normalisation. docs/solvers/essential_8pc.md
/// @param points  N ≥ 8; of their affinities only a mirror image
///                (det A < 0) counts, which is refused
/// @return        at most one E with |E| = √2
/// @degenerate    points of one plane, pure rotation, fewer than eight, not finite: empty
/// @cost          about 2 µs for eight, no allocation; pure, thread-safe
[[nodiscard]] SolutionSet<Eigen::Matrix3d, 1> essential_8pc(AcSpan points,
                                                            const double* weights = nullptr);

/// The one of the four motions of E that has most points in front of both cameras, |t| = 1; empty
/// when none has any.
[[nodiscard]] SolutionSet<RelativePose, 1> pose_from_essential(const Eigen::Matrix3d& E,
                                                               AcSpan points);

}  // namespace oneac
