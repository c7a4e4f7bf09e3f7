#include "math/gram_descent.h"
#include "math/sign_vote.h"
#include "one_ac/pitched_essential.h"

#include "oneac/solvers/relpose_1ac_planar_pitch.h"

#include <cmath>
#include <optional>

namespace oneac {
namespace {

using internal::Angles;
using internal::Essential;

constexpr std::size_t kStarts = 16;  // minimal solutions tried by the least-squares form

}  // namespace

SolutionSet<PitchedPose, 1> relpose_nac_planar_pitch(AcSpan acs, const double* weights,
                                                     double max_pitch) {
  const internal::Gram9 gram = internal::epipolar_gram(acs, weights);
  if (!(gram.trace() > 0.0) || !gram.allFinite()) return {};
  std::optional<PitchedPose> best;
  double least = 0.0;
  std::size_t starts = 0;
  for (std::size_t i = 0; i < acs.size() && starts < kStarts; ++i) {
    if (weights != nullptr && !(weights[i] > 0.0)) continue;
    const auto candidates = relpose_1ac_planar_pitch(acs[i], max_pitch);
    starts += candidates.empty() ? 0 : 1;
    for (const PitchedPose& start : candidates) {
      Essential E(Angles{std::atan2(start.planar.sin_alpha, start.planar.cos_alpha),
                         std::atan2(start.planar.tx, start.planar.tz), start.pitch});
      const double cost = internal::descend(gram, E);
      if (!std::isfinite(cost) || (best && !(cost < least))) continue;
      least = cost;
      best = E.angles.pose();
    }
  }
  if (!best) return {};
  const internal::SignVote vote(best->pose(), acs, weights);
  if (vote.voters == 0) return {};
  if (vote.balance < 0) best->planar.tx = -best->planar.tx, best->planar.tz = -best->planar.tz;
  return *best;
}

}  // namespace oneac
