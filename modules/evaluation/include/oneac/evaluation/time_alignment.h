#pragma once

#include "oneac/evaluation/trajectory_io.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace oneac {

/// How poses of two files belong together in time.
struct TimeAlignment {
  double offset_s = 0.0;  ///< added to the times of the estimate [s]
  /// [s] the nearest row of the reference may be so far away; empty: association.h's tolerance, or
  /// farther where poses are interpolated: between rows at most kLongestGap, or twice this, apart
  std::optional<double> max_difference_s;
};

/// Between rows further apart nothing is interpolated [s]: at 15 m/s and 20°/s a straight chord is
/// 4 cm off the arc.
inline constexpr double kLongestGap = 0.25;

/// A reference at the moments of an estimate.
struct ResampledReference {
  Trajectory trajectory;         ///< at those times that it covers; times are the estimate's
  std::size_t interpolated = 0;  ///< of them between two rows
};

/// The reference's pose at each time: the nearest row within time_tolerance(times), else on the
/// straight motion between the rows around it (translation linear, rotation at constant rate), else
/// the nearest row within max_difference_s; times without any are left out.
/// @param times  increasing, of the estimate before the offset  @pre the reference has times
[[nodiscard]] ResampledReference resampled(const Trajectory& reference,
                                           const std::vector<double>& times,
                                           const TimeAlignment& alignment);

/// [s] to be added to the estimate's times, so that both turn at the same moments: the shift with
/// the least mean square of the difference of their turns in half seconds, over all shifts at which
/// half of the shorter one overlaps. In whatever frames the poses are. Empty where they do not turn
/// enough, or no shift explains three quarters of the turns.
[[nodiscard]] std::optional<double> estimated_offset(const Trajectory& estimate,
                                                     const Trajectory& reference);

}  // namespace oneac
