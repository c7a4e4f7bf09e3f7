#include "oneac/robust/one_ac_consensus.h"

#include "consensus/mode_ranking.h"

#include "oneac/base/require.h"
#include "oneac/robust/degeneracy.h"

#include <algorithm>
#include <iterator>
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
  if (auto stood = standing(acs, bounds)) return *stood;

  const std::vector<internal::Candidate> modes = internal::ranked_modes(p, result.statistics);
  if (modes.empty()) return result;
  const MotionDecision decision = resting_or_moving(acs, modes.front().pose, bounds);
  if (decision.resting) {
    const RobustStatistics work = result.statistics;
    result = *decision.resting;
    result.statistics = work;
    return result;
  }
  conclude(decision.moving, acs, p.threshold, result);
  if (result.inlier_count < static_cast<std::size_t>(options.min_inliers)) {
    result.pose = {};
    result.covariance.setZero();
    return result;
  }
  result.status = PoseStatus::kOk;
  result.motion = decision.evidence;
  settle_one_plane(acs, R_level_cam, p.threshold, result);
  return result;
}

}  // namespace

void ConsensusOptions::validate() const {
  const bool some = std::find(pool.on.begin(), pool.on.end(), true) != pool.on.end();
  require(some, std::string("consensus.") + SolverPool::key(0), 0,
          "true when no other solver is on");
  require(threshold_px > 0.0, "consensus.threshold_px", threshold_px, "positive");
  require(pitch_sweep_deg >= 0.0 && pitch_sweep_deg <= 10.0, "consensus.pitch_sweep_deg",
          pitch_sweep_deg, "from 0 to 10");
  require(pitch_step_deg > 0.0, "consensus.pitch_step_deg", pitch_step_deg, "positive");
  require(roll_sweep_deg >= 0.0 && roll_sweep_deg <= 10.0, "consensus.roll_sweep_deg",
          roll_sweep_deg, "from 0 to 10");
  require(roll_step_deg > 0.0, "consensus.roll_step_deg", roll_step_deg, "positive");
  require(minimal_problems >= 1, "consensus.minimal_problems", minimal_problems, "at least 1");
  require(first_modes >= 0, "consensus.first_modes", first_modes, "at least 0");
  require(first_problems >= 1, "consensus.first_problems", first_problems, "at least 1");
  require(settled_cost >= 0.0 && settled_cost <= 1.0, "consensus.settled_cost", settled_cost,
          "from 0 to 1");
  require(finalists >= 1, "consensus.finalists", finalists, "at least 1");
  require(modes >= 1, "consensus.modes", modes, "at least 1");
  require(mode_rotation_deg >= 0.0, "consensus.mode_rotation_deg", mode_rotation_deg, "at least 0");
  require(mode_direction_deg >= 0.0, "consensus.mode_direction_deg", mode_direction_deg,
          "at least 0");
  require(min_inliers >= 5, "consensus.min_inliers", min_inliers, "at least 5");
  require(standing_px >= 0.0, "consensus.standing_px", standing_px, "at least 0");
}

RobustResult one_ac_consensus(AcSpan acs, const Eigen::Matrix3d& R_level_cam, double focal_px,
                              const ConsensusOptions& options, const MotionPrior& prior) {
  const auto is_finite = [](const AffineCorrespondence& ac) { return ac.is_finite(); };
  if (std::all_of(acs.begin(), acs.end(), is_finite)) {
    return consensus_of_finite(acs, R_level_cam, focal_px, options, prior);
  }
  std::vector<AffineCorrespondence> finite;
  finite.reserve(acs.size());
  std::copy_if(acs.begin(), acs.end(), std::back_inserter(finite), is_finite);
  RobustResult result = consensus_of_finite(finite, R_level_cam, focal_px, options, prior);
  std::vector<bool> inliers(acs.size(), false);
  for (std::size_t i = 0, k = 0; i < acs.size(); ++i) {
    if (acs[i].is_finite()) inliers[i] = result.inliers[k++];
  }
  result.inliers = std::move(inliers);
  return result;
}

}  // namespace oneac
