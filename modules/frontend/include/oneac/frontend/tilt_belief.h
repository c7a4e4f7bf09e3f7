#pragma once

#include "oneac/geometry/levelling.h"

namespace oneac {

/// An angle with its 1σ [rad].
struct AngleBelief {
  double angle = 0.0;
  double sigma = 0.0;
};

/// Tilt with its uncertainty.
struct TiltBelief {
  Tilt tilt;
  double pitch_sigma = 0.0;  ///< [rad] 1σ
  double roll_sigma = 0.0;   ///< [rad] 1σ
};

}  // namespace oneac
