#pragma once

#include <cmath>

namespace oneac {

/// The same angle from −π to π: a camera upside down leans to either side of half a turn.
[[nodiscard]] inline double wrapped_angle(double angle) {
  return std::abs(angle) <= M_PI ? angle : std::remainder(angle, 2.0 * M_PI);
}

}  // namespace oneac
