#include "agreement.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace oneac::internal {
namespace {

constexpr double kChi2 = 22.46;  // χ² of six degrees of freedom, 99.9 %
// [m] of way between loops that are compared: the odometry says where their ends lie to a few per
// mille of it, well below what a street repeats itself by.
constexpr double kNear_m = 25.0;
// Odometry and loops are believed to be so many times worse than they say where places that nothing
// tells apart are many metres away, and a loop that is refused is lost.
constexpr double kDoubt = 2.0;

// [m] 1σ of how far apart two cameras are whose images have a loop in common.
constexpr double kOnePlace_m = 5.0;
constexpr double kPlaceChi2 = 16.27;  // χ² of three degrees of freedom, 99.9 %
// [rad] Features of views that differ by more do not match.
constexpr double kMostTurn = 45.0 * M_PI / 180;

double squared_distance(const UncertainPose& error, double doubt) {
  const Vector6 e = small_motion(error.T);
  const Eigen::LDLT<Matrix6> solver(doubt * doubt * error.covariance);
  const double squared = e.dot(solver.solve(e));
  const bool told = solver.isPositive() && std::isfinite(squared);
  return told ? squared : std::numeric_limits<double>::infinity();
}

/// Whether the odometry is known between the ends of both.
bool comparable(const LoopConstraint& a, const LoopConstraint& b, const Chain& chain) {
  return chain.known(a.first, b.first) && chain.known(a.second, b.second);
}

/// Whether two loops close a cycle: first a → first b → second b → second a → first a.
bool agree(const LoopConstraint& a, const LoopConstraint& b, const Chain& chain) {
  const UncertainPose cycle = chain.between(a.first, b.first) * of_loop(b) *
                              chain.between(b.second, a.second) * inverse(of_loop(a));
  return squared_distance(cycle, 1.0) < kChi2;
}

/// What the loops near each say of it: others by place, and how many agree with it or do not.
struct Opinions {
  std::vector<std::vector<std::pair<std::size_t, bool>>> of;
  std::vector<std::size_t> yes, no;
  std::vector<bool> out;

  void add(std::size_t a, std::size_t b, bool agreed) {
    of[a].emplace_back(b, agreed);
    ++(agreed ? yes : no)[a];
  }
  void take_out(std::size_t loop) {
    out[loop] = true;
    for (const auto& [other, agreed] : of[loop]) --(agreed ? yes : no)[other];
  }
};

/// @pre loops in the order of `second`
Opinions opinions_on(const std::vector<LoopConstraint>& loops, const Chain& chain) {
  const std::size_t count = loops.size();
  Opinions opinions{std::vector<std::vector<std::pair<std::size_t, bool>>>(count),
                    std::vector<std::size_t>(count, 0), std::vector<std::size_t>(count, 0),
                    std::vector<bool>(count, false)};
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = a + 1; b < count; ++b) {
      if (chain.driven(loops[b].second) - chain.driven(loops[a].second) >= kNear_m) break;
      if (loops[a].second == loops[b].second || !comparable(loops[a], loops[b], chain)) continue;
      const bool agreed = agree(loops[a], loops[b], chain);
      opinions.add(a, b, agreed);
      opinions.add(b, a, agreed);
    }
  }
  return opinions;
}

/// The loop that is contradicted most of those that are not carried; none when all are.
std::optional<std::size_t> worst_of(const Opinions& opinions, std::size_t support) {
  std::optional<std::size_t> worst;
  const auto balance = [&](std::size_t i) {
    return static_cast<double>(opinions.yes[i]) - static_cast<double>(opinions.no[i]);
  };
  for (std::size_t i = 0; i < opinions.out.size(); ++i) {
    const bool carried = opinions.yes[i] >= support && opinions.yes[i] > opinions.no[i];
    if (opinions.out[i] || carried) continue;
    if (!worst || balance(i) < balance(*worst)) worst = i;
  }
  return worst;
}

/// Loops between two parts, by index.
using Indices = std::vector<std::size_t>;

/// Loops between two parts in groups that agree, the largest first.
class Placings {
 public:
  Placings(const std::vector<LoopConstraint>& loops, const Chain& chain)
      : loops_(loops), chain_(chain) {}

  /// The loop that most of the others agree with, and those.
  [[nodiscard]] Indices best_of(const Indices& all) const {
    const std::size_t stride = 1 + all.size() / kMostCompared;
    Indices best;
    for (std::size_t i = 0; i < all.size(); i += stride) {
      Indices own = agreeing_with(all[i], all);
      if (own.size() > best.size()) best = std::move(own);
    }
    return best;
  }

  /// [m] of way that they cover on the side where they cover less.
  [[nodiscard]] double way_of(const Indices& some) const {
    const auto covered = [&](std::size_t LoopConstraint::*end) {
      const auto [least, most] = std::minmax_element(
          some.begin(), some.end(),
          [&](std::size_t a, std::size_t b) { return loops_[a].*end < loops_[b].*end; });
      return chain_.driven(loops_[*most].*end) - chain_.driven(loops_[*least].*end);
    };
    if (some.empty()) return 0.0;
    return std::min(covered(&LoopConstraint::first), covered(&LoopConstraint::second));
  }

 private:
  [[nodiscard]] Indices agreeing_with(std::size_t loop, const Indices& all) const {
    Indices own;
    std::copy_if(all.begin(), all.end(), std::back_inserter(own), [&](std::size_t other) {
      return other == loop || agree(loops_[loop], loops_[other], chain_);
    });
    return own;
  }

  // Placings that are tried: one of every so many loops stands for its neighbours.
  static constexpr std::size_t kMostCompared = 200;

  const std::vector<LoopConstraint>& loops_;
  const Chain& chain_;
};

/// The first of each keyframe: others of it share the errors of its features.
Indices one_of_each(const Indices& some, const std::vector<LoopConstraint>& loops) {
  std::set<std::size_t> seen;
  Indices kept;
  std::copy_if(some.begin(), some.end(), std::back_inserter(kept),
               [&](std::size_t i) { return seen.insert(loops[i].second).second; });
  return kept;
}

/// Those of the loops between two parts that join them; none where two placings are possible.
Indices joining_pair(const Indices& all, const Placings& placings, double least_way_m) {
  const Indices best = placings.best_of(all);
  Indices others;
  std::set_difference(all.begin(), all.end(), best.begin(), best.end(), std::back_inserter(others));
  const std::size_t rival = placings.best_of(others).size();
  const bool joins = placings.way_of(best) >= least_way_m && best.size() > 2 * rival;
  return joins ? best : Indices{};
}

}  // namespace

bool may_meet(std::size_t a, std::size_t b, const Chain& chain) {
  if (!chain.known(a, b)) return !chain.apart_by_gps(a, b, kMostTurn);
  const UncertainPose way = chain.between(a, b);
  const Eigen::Matrix3d covariance = kDoubt * kDoubt * way.covariance.topLeftCorner<3, 3>() +
                                     kOnePlace_m * kOnePlace_m * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d t = way.T.translation();
  return t.dot(covariance.llt().solve(t)) < kPlaceChi2;
}

bool is_possible(const LoopConstraint& loop, const Chain& chain) {
  if (!chain.known(loop.first, loop.second)) {
    const double turn = Eigen::AngleAxisd(loop.T_2_1.R).angle();
    return !chain.apart_by_gps(loop.first, loop.second, turn) &&
           chain.can_be_driven(loop.first, loop.second, of_loop(loop).T);
  }
  const UncertainPose error = chain.between(loop.first, loop.second) * inverse(of_loop(loop));
  return squared_distance(error, kDoubt) < kChi2;
}

std::vector<LoopConstraint> agreeing(std::vector<LoopConstraint> loops, const Chain& chain,
                                     std::size_t support) {
  std::stable_sort(loops.begin(), loops.end(),
                   [](const auto& a, const auto& b) { return a.second < b.second; });
  Opinions opinions = opinions_on(loops, chain);
  while (const auto worst = worst_of(opinions, support)) opinions.take_out(*worst);
  std::vector<LoopConstraint> kept;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (!opinions.out[i]) kept.push_back(loops[i]);
  }
  return kept;
}

std::vector<LoopConstraint> joining(const std::vector<LoopConstraint>& loops, const Chain& chain,
                                    double least_way_m) {
  std::map<std::pair<std::size_t, std::size_t>, Indices> pairs;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    pairs[{chain.part(loops[i].first), chain.part(loops[i].second)}].push_back(i);
  }
  const Placings placings(loops, chain);
  Indices kept;
  for (const auto& [parts, all] : pairs) {
    const bool known = parts.first == parts.second;
    const Indices own = known ? all : one_of_each(joining_pair(all, placings, least_way_m), loops);
    kept.insert(kept.end(), own.begin(), own.end());
  }
  std::sort(kept.begin(), kept.end());
  std::vector<LoopConstraint> joined;
  for (const std::size_t i : kept) joined.push_back(loops[i]);
  return joined;
}

}  // namespace oneac::internal
