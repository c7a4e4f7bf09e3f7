#pragma once

#include "chain.h"

#include "oneac/loops/loop_constraint.h"

#include <cstddef>
#include <vector>

namespace oneac::internal {

/// Whether the odometry's way from one keyframe to the other allows the loop.
[[nodiscard]] bool is_possible(const LoopConstraint& loop, const Chain& chain);

/// Whether the odometry allows that the two keyframes see one place at all: before anything is
/// compared.
[[nodiscard]] bool may_meet(std::size_t a, std::size_t b, const Chain& chain);

/// The loops that agree with those around them: each closes a cycle with `support` others at least,
/// short ways of odometry on either side, and is contradicted by fewer than support it. What
/// contradicts most is taken out first.
[[nodiscard]] std::vector<LoopConstraint> agreeing(std::vector<LoopConstraint> loops,
                                                   const Chain& chain, std::size_t support);

}  // namespace oneac::internal
