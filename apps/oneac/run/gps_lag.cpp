#include "gps_lag.h"

#include "oneac/base/number_text.h"
#include "oneac/geometry/angles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace oneac::app {
namespace {

constexpr double kFurthest_s = 30.0, kStep_s = 0.05;
constexpr double kWindow_s = 2.0;          // two epochs of a receiver with one a second
constexpr double kGrid_s = 0.2;            // between windows
constexpr double kLeast_s = 0.25;          // receivers filter: a smaller lag is theirs
constexpr std::size_t kFewest = 25;        // windows that must be seen by both: 5 s
constexpr double kBend = 3.0 * kDegree;    // root mean square of the turns in windows
constexpr double kUnlike = 1.0 * kDegree;  // of the difference without a shift: a course is as good
constexpr double kBetter = 0.25;           // of the mean square that a shift must leave at most

/// Heading over time, counter-clockwise, without jumps of a full turn.
struct Headings {
  std::vector<double> times, angles;

  void add(double time, double angle) {
    const double before = angles.empty() ? angle : angles.back();
    times.push_back(time);
    angles.push_back(before + std::remainder(angle - before, 2.0 * M_PI));
  }
  /// Linear; empty beyond the ends and over gaps.
  [[nodiscard]] std::optional<double> at(double time) const {
    const auto next = std::upper_bound(times.begin(), times.end(), time);
    if (next == times.begin() || next == times.end()) return std::nullopt;
    const auto i = static_cast<std::size_t>(next - times.begin());
    constexpr double kLongestGap_s = 2.5;
    const double span = times[i] - times[i - 1];
    if (span > kLongestGap_s) return std::nullopt;
    return angles[i - 1] + (angles[i] - angles[i - 1]) * (time - times[i - 1]) / span;
  }
  /// What it changes by in the window that begins here.
  [[nodiscard]] std::optional<double> turn(double begin) const {
    const auto a = at(begin), b = at(begin + kWindow_s);
    return a && b ? std::optional(*b - *a) : std::nullopt;
  }
};

Headings headings_of(const Trajectory& vehicle) {
  Headings headings;
  for (std::size_t i = 0; i < vehicle.times.size(); ++i) {
    const Eigen::Matrix3d R = vehicle.poses[i].linear();
    headings.add(vehicle.times[i], std::atan2(R(1, 0), R(0, 0)));
  }
  return headings;
}

Headings courses_of(const VehicleReference& reference) {
  constexpr double kMoving_mps = 1.0;  // below, the course of a GPS is noise
  Headings courses;
  for (const GpsFix& fix : reference.gps) {
    const bool moving = fix.course && (!fix.speed || *fix.speed >= kMoving_mps);
    if (moving) courses.add(fix.time_s, -*fix.course);
  }
  return courses;
}

struct Turn {
  double begin_s, angle;
};

std::vector<Turn> turns_of(const Headings& headings) {
  std::vector<Turn> turns;
  if (headings.times.empty()) return turns;
  for (double t = headings.times.front(); t < headings.times.back(); t += kGrid_s) {
    if (const auto turn = headings.turn(t)) turns.push_back({t, *turn});
  }
  return turns;
}

/// How courses shifted by a lag differ from the turns.
struct Misfit {
  double mean_square = 0.0;  ///< [rad²]
  double turn_square = 0.0;  ///< [rad²] of the turns compared
};

std::optional<Misfit> misfit(const std::vector<Turn>& turns, const Headings& courses, double lag) {
  Misfit sum;
  std::size_t seen = 0;
  for (const Turn& turn : turns) {
    const auto course = courses.turn(turn.begin_s + lag);
    if (!course) continue;
    ++seen;
    sum.mean_square += (turn.angle - *course) * (turn.angle - *course);
    sum.turn_square += turn.angle * turn.angle;
  }
  if (seen < kFewest || 2 * seen < turns.size()) return std::nullopt;
  const auto count = static_cast<double>(seen);
  return Misfit{sum.mean_square / count, sum.turn_square / count};
}

}  // namespace

std::optional<double> lag_of_gps(const Trajectory& vehicle, const VehicleReference& reference) {
  const std::vector<Turn> turns = turns_of(headings_of(vehicle));
  const Headings courses = courses_of(reference);
  const auto as_stamped = misfit(turns, courses, 0.0);
  double best_lag = 0.0;
  std::optional<Misfit> best;
  for (double lag = -kFurthest_s; lag <= kFurthest_s; lag += kStep_s) {
    const auto shifted = misfit(turns, courses, lag);
    const bool bends = shifted && shifted->turn_square > kBend * kBend;
    if (!bends || (best && shifted->mean_square >= best->mean_square)) continue;
    best = shifted;
    best_lag = lag;
  }
  if (!best || std::abs(best_lag) < kLeast_s) return std::nullopt;
  // Without an overlap as stamped, the turns themselves are what is to be explained.
  const double before = as_stamped ? as_stamped->mean_square : best->turn_square;
  if (before < kUnlike * kUnlike || best->mean_square > kBetter * before) return std::nullopt;
  return best_lag;
}

std::string about_lag(double lag_s) {
  return "the GPS is stamped " + fixed_text(std::abs(lag_s), 1) + " s too " +
         (lag_s > 0.0 ? "late" : "early") +
         ", by its course against the turns of the images: correct its clock, or expect such "
         "errors "
         "in what it is compared with\n";
}

}  // namespace oneac::app
