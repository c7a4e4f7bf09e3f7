#pragma once

#include "oneac/evaluation/relative_poses_io.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace oneac {

/// Two times further apart than this never belong together [s]: at 15 m/s a car moves 15 cm.
inline constexpr double kLargestTimeOffset = 0.01;

/// A row of the estimate and the row of the reference that shows the same moment.
struct RowMatch {
  std::size_t estimate = 0;
  std::size_t reference = 0;
};

/// Which image of the log each row of a run's trajectory shows, and when it was taken.
struct ProcessedFrames {
  std::vector<std::size_t> indices;
  std::vector<double> times;  ///< Unix time [s]
};

/// The frames that a run's pairs connect, first frame first.
/// Empty when the pairs are none or do not form one chain (index2 of a row = index1 of the next).
[[nodiscard]] std::optional<ProcessedFrames> processed_frames(
    const std::vector<RelativePoseRow>& rows);

/// The offset up to which times count as the same moment [s]: half the median spacing, but at
/// most kLargestTimeOffset (which alone holds for fewer than two times).
[[nodiscard]] double time_tolerance(const std::vector<double>& times);

/// The row whose time is nearest; the earlier of two equally near; empty beyond the tolerance.
/// @pre times increase
[[nodiscard]] std::optional<std::size_t> nearest_row(const std::vector<double>& times, double time,
                                                     double tolerance);

/// Rows k with k, for as many as both have.
[[nodiscard]] std::vector<RowMatch> match_by_row(std::size_t estimate_rows,
                                                 std::size_t reference_rows);

/// Rows of the estimate with the reference rows their indices name; those beyond it are left out.
[[nodiscard]] std::vector<RowMatch> match_by_index(const std::vector<std::size_t>& indices,
                                                   std::size_t reference_rows);

/// Each row of the estimate with the nearest in time, within time_tolerance(estimate); a reference
/// row is used once, by the nearest. @pre both increase
[[nodiscard]] std::vector<RowMatch> match_by_time(const std::vector<double>& estimate,
                                                  const std::vector<double>& reference);

}  // namespace oneac
