#pragma once

#include "points/five_point_cubics.h"

#include "oneac/solvers/solution_set.h"

namespace oneac::internal {

/// The essential matrices in a null space of five equations, up to scale, with the digits that the
/// elimination leaves: to be polished. Empty for a continuum of them.
/// @param basis  well_scaled
[[nodiscard]] SolutionSet<Eigen::Matrix3d, 10> essentials_of(const Basis& basis);

}  // namespace oneac::internal
