#pragma once

#include "oneac/report/overlay.h"

namespace oneac::internal {

[[nodiscard]] bool is_finite(const Mark& mark);
/// Corners [px] of what A makes of a square around u1, moved to u2.
[[nodiscard]] std::array<Eigen::Vector2d, 4> corners_of(const Mark& mark);

}  // namespace oneac::internal
