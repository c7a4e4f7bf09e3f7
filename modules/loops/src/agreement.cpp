#include "agreement.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace oneac::internal {
namespace {

constexpr double kChi2 = 22.46;  // χ² of six degrees of freedom, 99.9 %
// [m] of way between loops that are compared: the odometry says where their ends lie to a few per
// mille of it, well below what a street repeats itself by.
constexpr double kNear_m = 25.0;
// Odometry and loops are believed to be so many times worse than they say where places that nothing
// tells apart are many metres away, and a loop that is refused is lost.
constexpr double kDoubt = 2.0;

double squared_distance(const UncertainPose& error, double doubt) {
  const Vector6 e = small_motion(error.T);
  const Eigen::LDLT<Matrix6> solver(doubt * doubt * error.covariance);
  return solver.isPositive() ? e.dot(solver.solve(e)) : 0.0;
}

/// Whether two loops close a cycle: first a → first b → second b → second a → first a.
bool agree(const LoopConstraint& a, const LoopConstraint& b, const Chain& chain) {
  const UncertainPose cycle = chain.between(a.first, b.first) * of_loop(b) *
                              chain.between(b.second, a.second) * inverse(of_loop(a));
  return squared_distance(cycle, 1.0) < kChi2;
}

bool near(const LoopConstraint& a, const LoopConstraint& b, const Chain& chain) {
  return std::abs(chain.driven(a.second) - chain.driven(b.second)) < kNear_m &&
         a.second != b.second;
}

/// Per loop: how many of those near it agree, and how many do not.
struct Votes {
  std::size_t yes = 0, no = 0;
};

Votes votes_on(const LoopConstraint& loop, const std::vector<LoopConstraint>& loops,
               const Chain& chain) {
  Votes votes;
  for (const LoopConstraint& other : loops) {
    if (!near(loop, other, chain)) continue;
    ++(agree(loop, other, chain) ? votes.yes : votes.no);
  }
  return votes;
}

}  // namespace

bool is_possible(const LoopConstraint& loop, const Chain& chain) {
  const UncertainPose error = chain.between(loop.first, loop.second) * inverse(of_loop(loop));
  return squared_distance(error, kDoubt) < kChi2;
}

std::vector<LoopConstraint> agreeing(std::vector<LoopConstraint> loops, const Chain& chain,
                                     std::size_t support) {
  while (!loops.empty()) {
    auto worst = loops.end();
    double least = 0.0;
    for (auto at = loops.begin(); at != loops.end(); ++at) {
      const Votes votes = votes_on(*at, loops, chain);
      const bool carried = votes.yes >= support && votes.yes > votes.no;
      if (carried) continue;
      const double balance = static_cast<double>(votes.yes) - static_cast<double>(votes.no);
      if (worst != loops.end() && balance >= least) continue;
      worst = at;
      least = balance;
    }
    if (worst == loops.end()) return loops;
    loops.erase(worst);
  }
  return loops;
}

}  // namespace oneac::internal
