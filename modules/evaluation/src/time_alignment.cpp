#include "oneac/evaluation/time_alignment.h"

#include "oneac/evaluation/association.h"
#include "oneac/geometry/angles.h"

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

Eigen::Isometry3d between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double share) {
  const Eigen::Quaterniond qa(a.linear()), qb(b.linear());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = qa.slerp(share, qb).normalized().toRotationMatrix();
  pose.translation() = a.translation() + share * (b.translation() - a.translation());
  return pose;
}

/// The pose on the motion between the rows around a time; empty over gaps and beyond the ends.
std::optional<Eigen::Isometry3d> interpolated(const Trajectory& reference, double time,
                                              double longest_gap) {
  const auto& times = reference.times;
  const auto next = std::upper_bound(times.begin(), times.end(), time);
  if (next == times.begin() || next == times.end()) return std::nullopt;
  const auto i = static_cast<std::size_t>(next - times.begin());
  const double gap = times[i] - times[i - 1];
  if (gap > longest_gap) return std::nullopt;
  return between(reference.poses[i - 1], reference.poses[i], (time - times[i - 1]) / gap);
}

constexpr double kWindow_s = 0.5;
constexpr double kCoarse_s = 0.1, kFine_s = 0.005;
constexpr double kExplained = 0.25;           // of the turns' square may be left
constexpr double kLeastTurn = 0.5 * kDegree;  // root mean square in a window
constexpr std::size_t kFewest = 20;           // windows
constexpr std::size_t kMostWindows = 4000;    // over a long drive they are spread

/// How much a trajectory turns in the window from here on [rad]; empty where it has no poses.
std::optional<double> turn_at(const Trajectory& trajectory, double time) {
  constexpr double kGap_s = 1.5;  // of a GPS with one epoch a second
  const auto a = interpolated(trajectory, time, kGap_s);
  const auto b = interpolated(trajectory, time + kWindow_s, kGap_s);
  if (!a || !b) return std::nullopt;
  return Eigen::AngleAxisd(a->linear().transpose() * b->linear()).angle();
}

struct Turn {
  double time, angle;
};

std::vector<Turn> turns_of(const Trajectory& trajectory) {
  const double span = trajectory.times.back() - trajectory.times.front();
  const double step = std::max(kCoarse_s, span / static_cast<double>(kMostWindows));
  std::vector<Turn> turns;
  for (std::size_t i = 0; static_cast<double>(i) * step < span; ++i) {
    const double time = trajectory.times.front() + static_cast<double>(i) * step;
    if (const auto angle = turn_at(trajectory, time)) turns.push_back({time, *angle});
  }
  return turns;
}

/// Turns on a grid of time, for shifts by whole cells.
struct TurnGrid {
  double begin = 0.0;
  std::vector<double> angles;  ///< NaN where there is none

  explicit TurnGrid(const Trajectory& trajectory) : begin(trajectory.times.front()) {
    const double span = trajectory.times.back() - begin;
    for (std::size_t i = 0; static_cast<double>(i) * kFine_s < span; ++i) {
      const auto angle = turn_at(trajectory, begin + static_cast<double>(i) * kFine_s);
      angles.push_back(angle.value_or(std::nan("")));
    }
  }
  [[nodiscard]] double at(double time) const {
    const double cell = std::round((time - begin) / kFine_s);
    if (!(cell >= 0.0) || cell >= static_cast<double>(angles.size())) return std::nan("");
    return angles[static_cast<std::size_t>(cell)];
  }
};

struct Fit {
  double offset = 0.0;
  double left = 0.0;  ///< mean square of the differences [rad²]
  double turn = 0.0;  ///< of the turns
};

std::optional<Fit> fit_at(const std::vector<Turn>& turns, const TurnGrid& grid, double offset,
                          std::size_t least) {
  Fit fit{offset, 0.0, 0.0};
  std::size_t seen = 0;
  for (const Turn& turn : turns) {
    const double other = grid.at(turn.time + offset);
    if (std::isnan(other)) continue;
    ++seen;
    fit.left += (turn.angle - other) * (turn.angle - other);
    fit.turn += turn.angle * turn.angle;
  }
  if (seen < least) return std::nullopt;
  fit.left /= static_cast<double>(seen);
  fit.turn /= static_cast<double>(seen);
  return fit;
}

/// The best of the offsets from `first` on; the ratio decides, so that a straight piece, where
/// anything fits, does not win.
std::optional<Fit> best_of(const std::vector<Turn>& turns, const TurnGrid& grid, double first,
                           double last, double step, std::size_t least) {
  std::optional<Fit> best;
  const auto count = static_cast<std::size_t>((last - first) / step) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const auto fit = fit_at(turns, grid, first + static_cast<double>(i) * step, least);
    if (!fit || fit->turn < kLeastTurn * kLeastTurn) continue;
    if (!best || fit->left * best->turn < best->left * fit->turn) best = fit;
  }
  return best;
}

}  // namespace

ResampledReference resampled(const Trajectory& reference, const std::vector<double>& times,
                             const TimeAlignment& alignment) {
  const double tolerance = time_tolerance(times);
  const double furthest = alignment.max_difference_s.value_or(tolerance);
  const double gap = std::max(kLongestGap, 2.0 * furthest);
  ResampledReference result;
  const auto add = [&](double time, const Eigen::Isometry3d& pose) {
    result.trajectory.times.push_back(time);
    result.trajectory.poses.push_back(pose);
  };
  for (const double time : times) {
    const double wanted = time + alignment.offset_s;
    const bool lies_near =
        !alignment.max_difference_s || nearest_row(reference.times, wanted, furthest);
    if (!lies_near) continue;
    const auto same = nearest_row(reference.times, wanted, std::min(tolerance, furthest));
    if (same) {
      add(time, reference.poses[*same]);
    } else if (const auto pose = interpolated(reference, wanted, gap)) {
      add(time, *pose);
      ++result.interpolated;
    } else if (const auto row = nearest_row(reference.times, wanted, furthest)) {
      add(time, reference.poses[*row]);
    }
  }
  return result;
}

std::optional<double> estimated_offset(const Trajectory& estimate, const Trajectory& reference) {
  if (estimate.times.size() < 2 || reference.times.size() < 2) return std::nullopt;
  const std::vector<Turn> turns = turns_of(estimate);
  const double span = estimate.times.back() - estimate.times.front();
  const double other = reference.times.back() - reference.times.front();
  const double shorter = std::min(span, other);
  const double share = span > 0.0 ? 0.5 * shorter / span : 0.0;
  const auto least =
      std::max(kFewest, static_cast<std::size_t>(share * static_cast<double>(turns.size())));
  const TurnGrid grid(reference);
  const double first = reference.times.front() - estimate.times.back() + 0.5 * shorter;
  const double last = reference.times.back() - estimate.times.front() - 0.5 * shorter;
  const auto coarse = best_of(turns, grid, first, last, kCoarse_s, least);
  if (!coarse) return std::nullopt;
  const auto fine = best_of(turns, grid, coarse->offset - 2.0 * kCoarse_s,
                            coarse->offset + 2.0 * kCoarse_s, kFine_s, least);
  if (!fine || fine->left > kExplained * fine->turn) return std::nullopt;
  return fine->offset;
}

}  // namespace oneac
