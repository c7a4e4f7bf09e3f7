#include "agreement.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
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

double squared_distance(const UncertainPose& error, double doubt) {
  const Vector6 e = small_motion(error.T);
  const Eigen::LDLT<Matrix6> solver(doubt * doubt * error.covariance);
  const double squared = e.dot(solver.solve(e));
  const bool told = solver.isPositive() && std::isfinite(squared);
  return told ? squared : std::numeric_limits<double>::infinity();
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
      if (loops[a].second == loops[b].second) continue;
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

}  // namespace

bool may_meet(std::size_t a, std::size_t b, const Chain& chain) {
  const UncertainPose way = chain.between(a, b);
  const Eigen::Matrix3d covariance = kDoubt * kDoubt * way.covariance.topLeftCorner<3, 3>() +
                                     kOnePlace_m * kOnePlace_m * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d t = way.T.translation();
  return t.dot(covariance.llt().solve(t)) < kPlaceChi2;
}

bool is_possible(const LoopConstraint& loop, const Chain& chain) {
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

}  // namespace oneac::internal
