#pragma once

#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

namespace oneac::internal {

/// H with a middle singular value of one and x2ᵀ H x1 > 0 for most points; empty when it is
/// singular.
[[nodiscard]] SolutionSet<Eigen::Matrix3d, 1> scaled_homography(const Eigen::Matrix3d& H,
                                                                AcSpan acs, const double* weights);

}  // namespace oneac::internal
