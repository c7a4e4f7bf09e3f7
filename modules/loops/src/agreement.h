#pragma once

#include "chain.h"

#include "oneac/loops/loop_constraint.h"

#include <cstddef>
#include <vector>

namespace oneac::internal {

/// Whether the odometry's way from one keyframe to the other allows the loop; where tracking was
/// lost between them, whether a car could have driven so far in that time.
[[nodiscard]] bool is_possible(const LoopConstraint& loop, const Chain& chain);

/// Whether odometry, or GPS where that knows nothing, allows that the two keyframes see one place
/// at all: before anything is compared.
[[nodiscard]] bool may_meet(std::size_t a, std::size_t b, const Chain& chain);

/// The loops that agree with those around them: each closes a cycle with `support` others at least,
/// short ways of odometry on either side, and is contradicted by fewer than support it. What
/// contradicts most is taken out first.
/// Loops are compared where the odometry between both their ends is known.
[[nodiscard]] std::vector<LoopConstraint> agreeing(std::vector<LoopConstraint> loops,
                                                   const Chain& chain, std::size_t support);

/// Without the loops between two parts of the way that do not join them beyond doubt: no odometry
/// says where one part lies in the other, and places that look alike deceive all of a stretch. What
/// stays are those that agree with one placing, over `least_way_m` of both parts, if the next best
/// placing has less than half as many; of each later keyframe the first.
[[nodiscard]] std::vector<LoopConstraint> joining(const std::vector<LoopConstraint>& loops,
                                                  const Chain& chain, double least_way_m);

}  // namespace oneac::internal
