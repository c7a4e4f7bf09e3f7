#include "oneac/evaluation/association.h"

#include "oneac/evaluation/statistics.h"

#include <algorithm>
#include <cmath>

namespace oneac {

std::optional<ProcessedFrames> processed_frames(const std::vector<RelativePoseRow>& rows) {
  if (rows.empty()) return std::nullopt;
  ProcessedFrames frames{{rows.front().index1}, {rows.front().t1}};
  for (const RelativePoseRow& row : rows) {
    if (row.index1 != frames.indices.back()) return std::nullopt;
    frames.indices.push_back(row.index2);
    frames.times.push_back(row.t2);
  }
  return frames;
}

double time_tolerance(const std::vector<double>& times) {
  if (times.size() < 2) return kLargestTimeOffset;
  std::vector<double> spacings;
  for (std::size_t k = 1; k < times.size(); ++k) spacings.push_back(times[k] - times[k - 1]);
  return std::min(0.5 * percentile(std::move(spacings), 50.0), kLargestTimeOffset);
}

std::optional<std::size_t> nearest_row(const std::vector<double>& times, double time,
                                       double tolerance) {
  if (times.empty()) return std::nullopt;
  const auto after = std::lower_bound(times.begin(), times.end(), time);
  auto nearest = after;
  if (after == times.end() || (after != times.begin() && time - *(after - 1) <= *after - time)) {
    nearest = after - 1;
  }
  if (!(std::abs(*nearest - time) <= tolerance)) return std::nullopt;
  return static_cast<std::size_t>(nearest - times.begin());
}

std::vector<RowMatch> match_by_row(std::size_t estimate_rows, std::size_t reference_rows) {
  std::vector<RowMatch> matches;
  for (std::size_t k = 0; k < std::min(estimate_rows, reference_rows); ++k) {
    matches.push_back({k, k});
  }
  return matches;
}

std::vector<RowMatch> match_by_index(const std::vector<std::size_t>& indices,
                                     std::size_t reference_rows) {
  std::vector<RowMatch> matches;
  for (std::size_t k = 0; k < indices.size(); ++k) {
    if (indices[k] < reference_rows) matches.push_back({k, indices[k]});
  }
  return matches;
}

std::vector<RowMatch> match_by_time(const std::vector<double>& estimate,
                                    const std::vector<double>& reference) {
  const double tolerance = time_tolerance(estimate);
  std::vector<RowMatch> matches;
  for (std::size_t k = 0; k < estimate.size(); ++k) {
    const auto row = nearest_row(reference, estimate[k], tolerance);
    if (!row) continue;
    if (matches.empty() || matches.back().reference != *row) {
      matches.push_back({k, *row});
    } else if (std::abs(estimate[k] - reference[*row]) <
               std::abs(estimate[matches.back().estimate] - reference[*row])) {
      matches.back().estimate = k;
    }
  }
  return matches;
}

}  // namespace oneac
