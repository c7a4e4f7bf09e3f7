#pragma once

#include "arrays.h"

#include "oneac/solvers/registry.h"

#include <cstddef>
#include <functional>

namespace oneac::python {

constexpr std::size_t kBlock = 512;  // correspondences: 32 kB, which the first cache holds

/// Gives one planar motion, or none, per correspondence.
[[nodiscard]] bool has_planar(const Solver& solver);

/// That motion of each correspondence, several at a time where the list has such a form.
/// @throws std::invalid_argument naming what is not finite
void solve_planar(const Solver& solver, const AcInput& acs, const PlanarPoseArrays& poses);

/// Takes the motions of `count` correspondences from `first` on.
using TakeBlock =
    std::function<void(std::size_t first, std::size_t count, const PlanarPoseArrays& poses)>;

/// The same, block by block. @pre solver.batch is there and the input has affinities
void solve_in_blocks(const Solver& solver, const AcInput& acs, const TakeBlock& take);

}  // namespace oneac::python
