#include "oneac/robust/one_ac_consensus.h"

#include "consensus/mode_ranking.h"

#include "oneac/base/check_bounds.h"
#include "oneac/base/require.h"
#include "oneac/robust/degeneracy.h"
#include "oneac/robust/finite_acs.h"

#include <algorithm>
#include <string>
#include <utility>

namespace oneac {
namespace {

/// The consensus of correspondences that are all finite.
RobustResult consensus_of_finite(AcSpan acs, const Eigen::Matrix3d& R_level_cam, double focal_px,
                                 const ConsensusOptions& options, const MotionPrior& prior) {
  RobustResult result;
  result.inliers.assign(acs.size(), false);
  if (acs.size() < static_cast<std::size_t>(options.min_inliers)) return result;
  const internal::ConsensusProblem p(acs, R_level_cam, options.threshold_px / focal_px, options);
  const DegeneracyBounds bounds{p.threshold, options.standing_px / focal_px, R_level_cam, prior};
  if (auto stood = find_standing(acs, bounds)) return *stood;

  const std::vector<internal::Candidate> modes = internal::ranked_modes(p, result.statistics);
  if (modes.empty()) return result;
  const MotionDecision decision = resting_or_moving(acs, modes.front().pose, bounds);
  if (decision.resting) {
    const RobustStatistics work = result.statistics;
    result = *decision.resting;
    result.statistics = work;
    return result;
  }
  complete_result(decision.moving, acs, p.threshold, result);
  if (result.inlier_count < static_cast<std::size_t>(options.min_inliers)) {
    result.pose = {};
    result.covariance.setZero();
    return result;
  }
  result.status = PoseStatus::kOk;
  result.motion = decision.evidence;
  resolve_one_plane(acs, R_level_cam, p.threshold, result);
  return result;
}

}  // namespace

void ConsensusOptions::validate() const {
  const bool some = std::find(pool.on.begin(), pool.on.end(), true) != pool.on.end();
  require(some, std::string("consensus.") + SolverPool::key(0), 0,
          "true when no other solver is on");
  check_bounds("consensus", *this);
}

RobustResult one_ac_consensus(AcSpan acs, const Eigen::Matrix3d& R_level_cam, double focal_px,
                              const ConsensusOptions& options, const MotionPrior& prior) {
  const FiniteAcs finite(acs);
  RobustResult result = consensus_of_finite(finite.acs(), R_level_cam, focal_px, options, prior);
  result.inliers = finite.spread(std::move(result.inliers));
  return result;
}

}  // namespace oneac
