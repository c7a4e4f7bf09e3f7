#pragma once

#include <vector>

namespace oneac {

/// Relative pitches 0, +step, −step, +2 step, … within ±range [rad]; just 0 when either is 0.
[[nodiscard]] std::vector<double> pitch_sweep(double range, double step);

}  // namespace oneac
