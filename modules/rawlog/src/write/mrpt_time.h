#pragma once

#include <mrpt/core/Clock.h>

#include <cmath>

namespace oneac {

/// Unix time as MRPT's stamp, rounded to its ticks of 100 ns (MRPT's own conversion truncates).
[[nodiscard]] inline mrpt::Clock::time_point mrpt_time(double time_s) {
  constexpr double kTicksPerSecond = 1e7;
  const double whole = std::floor(time_s);
  const auto ticks = std::llround((time_s - whole) * kTicksPerSecond);
  return mrpt::Clock::fromDouble(whole) + mrpt::Clock::duration(ticks);
}

}  // namespace oneac
