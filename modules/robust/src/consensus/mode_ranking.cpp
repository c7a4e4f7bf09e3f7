#include "consensus/mode_ranking.h"

#include "consensus/evenly_spaced.h"

#include "oneac/geometry/angles.h"
#include "oneac/geometry/essential.h"
#include "oneac/robust/polish.h"
#include "oneac/robust/rotation_only.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace oneac::internal {
namespace {

// Hypotheses scored again on more points before they are thinned to distinct modes: near-copies of
// the best one crowd the top.
constexpr std::size_t kShortList = 128;
constexpr std::size_t kFirstShortList = 32;
// Point pairs of the first polishing pass. Of the whole search: with 80 % outliers still forty that
// the motion explains. Of the first look, which is for few outliers: as many of 96 with one half.
constexpr std::size_t kSample = 192;
constexpr std::size_t kFirstSample = 96;
// Width of the first polishing pass against the second: reaches from the sweep's half step, about
// two pixels, into the basin.
constexpr double kWideLoss = 3.0;
constexpr int kWideIterations = 4;
constexpr int kNarrowIterations = 4;
// A single finalist is not compared with others, and the last pass takes it to the minimum.
constexpr int kLoneIterations = 2;
// Modes closer than both after the first pass are in one basin: a point at 40° moves by half a
// pixel at f = 700 px.
constexpr double kMetRotationDeg = 0.05;
constexpr double kMetDirectionDeg = 1.0;
// Steps of the first passes need not be finer than the last pass [rad].
constexpr double kCoarseStep = 1e-5;
// Share of the deciding cost below which other modes need not be looked at.
constexpr double kNoDoubt = 0.25;
// Bound [rad] that tells motions apart: one pixel at f = 700. What a wrong motion leaves is an
// angle, decided by the scene, from 0.8 mrad (KITTI). In squares of the bound it is the less, the
// wider the bound or the smaller the image: a wrong motion costs 0.345 a point at one pixel, 0.04
// at three.
constexpr double kTellingBound = 1.0 / 700.0;
// Motions farther apart than either are in different basins: what counts as a wrong one.
constexpr double kBasinRotationDeg = 1.0;
constexpr double kBasinDirectionDeg = 15.0;
// A motion decides when the points shift by so many bounds beside its rotation (median):
// below, a wrong direction of travel leaves them within the bound as well.
constexpr double kClearShift = 3.0;

/// How close two poses are to count as one, as cosines.
struct Closeness {
  double cos_rotation, cos_direction;

  Closeness(double rotation_deg, double direction_deg)
      : cos_rotation(std::cos(rotation_deg * kDegree)),
        cos_direction(std::cos(direction_deg * kDegree)) {}

  /// Directions of t are compared without their sign: it is decided at the end.
  [[nodiscard]] bool same(const RelativePose& a, const RelativePose& b) const {
    const double trace = (a.R.array() * b.R.array()).sum();
    return 0.5 * (trace - 1.0) > cos_rotation && std::abs(a.t.dot(b.t)) > cos_direction;
  }
};

/// The first of each group of close poses, at most `count`. @param sorted  best first
std::vector<Candidate> distinct(const std::vector<Candidate>& sorted, const Closeness& close,
                                int count) {
  std::vector<Candidate> kept;
  for (const Candidate& candidate : sorted) {
    if (kept.size() >= static_cast<std::size_t>(count)) break;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Candidate& mode) {
      return close.same(mode.pose, candidate.pose);
    });
    if (!known) kept.push_back(candidate);
  }
  return kept;
}

double cost_of(const RelativePose& pose, const PointSet& points, double threshold) {
  return msac_cost(essential_matrix(pose), points, threshold,
                   std::numeric_limits<double>::infinity());
}

void sort_by_cost(std::vector<Candidate>& candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
}

void rank(std::vector<Candidate>& candidates, const PointSet& points, double threshold) {
  for (Candidate& c : candidates) c.cost = cost_of(c.pose, points, threshold);
  sort_by_cost(candidates);
}

/// One of the two looks at the problem: its sample of the points and how many modes go on.
class Look {
 public:
  Look(const ConsensusProblem& problem, std::size_t sample, RobustStatistics& statistics)
      : p_(problem), sample_(evenly_spaced(problem.acs, sample)), statistics_(statistics) {}

  /// Whether a motion explains the points so well that no other can. Residuals spread evenly
  /// within the bound, of a motion that says nothing, cost 1/3 a point, and the right motion at
  /// most 1/4 where the bound is no less than two sigma of the noise.
  [[nodiscard]] bool decides(const Candidate& c, const PointSet& points, double share = 1.0) const {
    const double wider = std::max(1.0, p_.threshold / kTellingBound);
    return c.cost * wider * wider <
           share * p_.options.settled_cost * static_cast<double>(points.size());
  }

  /// The distinct hypotheses, best first.
  std::vector<Candidate> modes(SearchResult found, int count) {
    statistics_.iterations += found.solved;
    statistics_.hypotheses += found.hypotheses;
    rank(found.best, sample_, kWideLoss * p_.threshold);
    return distinct(found.best, {p_.options.mode_rotation_deg, p_.options.mode_direction_deg},
                    count);
  }

  /// Polishes all modes widely on the sample.
  void polish_all_on_sample(std::vector<Candidate>& modes) {
    for (Candidate& c : modes) polish_on_sample(c);
    sort_by_cost(modes);
  }

  /// The best of the modes polished on the sample, looking no further than there is doubt: not
  /// behind a mode that leaves none, and not at modes in the basin of one that decides.
  std::optional<Candidate> best_on_sample(const std::vector<Candidate>& modes) {
    const Closeness one_basin(kBasinRotationDeg, kBasinDirectionDeg);
    std::optional<Candidate> best;
    for (const Candidate& mode : modes) {
      if (best && decides(*best, sample_, kNoDoubt)) break;
      if (best && decides(*best, sample_) && one_basin.same(best->pose, mode.pose)) continue;
      Candidate polished = mode;
      polish_on_sample(polished);
      if (!best || polished.cost < best->cost) best = polished;
    }
    return best;
  }

  /// The best modes polished on all points. Modes of one basin have met by now.
  [[nodiscard]] std::vector<Candidate> finalists(const std::vector<Candidate>& modes) const {
    std::vector<Candidate> best =
        distinct(modes, {kMetRotationDeg, kMetDirectionDeg}, p_.options.finalists);
    const int iterations = best.size() == 1 ? kLoneIterations : kNarrowIterations;
    for (Candidate& c : best) {
      c.pose = polish_coarsely(c.pose, p_.points, {p_.threshold, iterations, kCoarseStep}).pose;
    }
    rank(best, p_.points, p_.threshold);
    return best;
  }

 private:
  void polish_on_sample(Candidate& c) {
    const double wide = kWideLoss * p_.threshold;
    c.pose = polish_coarsely(c.pose, sample_, {wide, kWideIterations, kCoarseStep}).pose;
    c.cost = cost_of(c.pose, sample_, p_.threshold);
    ++statistics_.local_optimisations;
  }

  const ConsensusProblem& p_;
  PointSet sample_;
  RobustStatistics& statistics_;
};

/// At most one mode, polished on all points; empty when it does not decide.
std::vector<Candidate> first_look(const ConsensusProblem& p, RobustStatistics& statistics) {
  Look look(p, kFirstSample, statistics);
  const std::vector<Candidate> modes =
      look.modes(search_level_poses(p.acs, p.R_level_cam, p.threshold, kFirstShortList, p.options),
                 p.options.first_modes);
  const std::optional<Candidate> favourite = look.best_on_sample(modes);
  if (!favourite) return {};
  std::vector<Candidate> best = look.finalists({*favourite});
  const double shift = median_transfer_error(best.front().pose.R, p.acs, kFirstSample);
  const bool stands = look.decides(best.front(), p.points) && shift > kClearShift * p.threshold;
  return stands ? best : std::vector<Candidate>{};
}

}  // namespace

std::vector<Candidate> ranked_modes(const ConsensusProblem& p, RobustStatistics& statistics) {
  if (p.options.first_modes > 0) {
    std::vector<Candidate> first = first_look(p, statistics);
    if (!first.empty()) return first;
  }
  Look look(p, kSample, statistics);
  std::vector<Candidate> modes = look.modes(
      search_poses(p.acs, p.R_level_cam, p.threshold, kShortList, p.options), p.options.modes);
  look.polish_all_on_sample(modes);
  return look.finalists(modes);
}

}  // namespace oneac::internal
