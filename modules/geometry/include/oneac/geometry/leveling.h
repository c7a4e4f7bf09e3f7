#pragma once

// The older spelling, for programs that were written against it: oneac/geometry/levelling.h.
#include "oneac/geometry/levelling.h"

namespace oneac {

/// levelling_rotation() by its older name.
[[nodiscard]] inline Eigen::Matrix3d leveling_rotation(const Tilt& tilt) {
  return levelling_rotation(tilt);
}

}  // namespace oneac
