#pragma once

#include "math/thresholds.h"

#include "oneac/base/simd_lanes.h"

namespace oneac::internal {
namespace {

using Lanes = DoubleLanes;
using Mask = MaskLanes;

/// One correspondence per lane: x1 = (x, y), x2 = (u, v), A = [a1 a2; a3 a4].
struct AcLanes {
  Lanes x, y, u, v, a1, a2, a3, a4;

  /// Finite, not mirrored, as is_usable().
  [[nodiscard]] Mask usable() const {
    const Lanes zero = x * 0.0 + y * 0.0 + u * 0.0 + v * 0.0 + a1 * 0.0 + a2 * 0.0 + a3 * 0.0 +
                       a4 * 0.0;  // NaN when any is not finite
    return (zero == 0.0) & (a1 * a4 - a2 * a3 > 0.0);
  }
};

/// One pose per lane. `empty` and `solved` exclude each other; where neither is set the scalar
/// solver has to decide.
struct PoseLanes {
  Lanes cos_alpha, sin_alpha, tx, tz;
  Mask empty, solved;
};

}  // namespace
}  // namespace oneac::internal
