#include "two_view.h"

#include "basin_choice.h"
#include "below_the_sky.h"
#include "by_depths.h"
#include "perspective_correction.h"
#include "plausible_depths.h"
#include "sense_of_travel.h"

#include "oneac/base/thread_clock.h"
#include "oneac/frontend/front_end_options.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <utility>

namespace oneac {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

TwoView standing(TrackedPair pair, double focal_px) {
  TwoView stands;
  stands.status = StepStatus::kNoMotion;
  stands.inliers.assign(pair.size(), true);
  stands.inlier_count = pair.size();
  stands.pair = std::move(pair);
  stands.focal_px = focal_px;
  return stands;
}

StepStatus step_status(PoseStatus status) {
  if (status == PoseStatus::kTooFew) return StepStatus::kPredicted;
  return is_stationary(status) ? StepStatus::kNoMotion : StepStatus::kOk;
}

RelativePose with_unit_length(RelativePose motion) {
  if (motion.t.norm() > 0.0) motion.t.normalize();
  return motion;
}

std::vector<AffineCorrespondence> those_of(std::vector<AffineCorrespondence> acs,
                                           const std::vector<bool>& told) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (told[i]) acs[kept++] = acs[i];
  }
  acs.resize(kept);
  return acs;
}

/// Flags of those that were told, with the others false.
std::vector<bool> among_all(const std::vector<bool>& flags, const std::vector<bool>& told) {
  std::vector<bool> all(told.size(), false);
  std::size_t next = 0;
  for (std::size_t i = 0; i < told.size(); ++i) {
    if (told[i]) all[i] = flags[next++];
  }
  return all;
}

/// Whether any is left to go by; `told` then says which.
bool take_the_sky_apart(const TrackedPair& pair, const TwoViewPrior& prior,
                        std::vector<bool>& told) {
  std::vector<bool> below = below_the_sky(pair, prior.R_level_cam);
  if (below.empty()) return false;
  told = std::move(below);
  return true;
}

/// By the right image, else by the map; empty when nobody knows one.
PointDepths depths_of(const TrackedPair& pair, const PointDepths& by_map) {
  PointDepths depths = by_map.size() == pair.size() ? by_map : PointDepths(pair.size());
  for (std::size_t i = 0; i < pair.size(); ++i) {
    if (pair.correspondences[i].depth) depths[i] = pair.correspondences[i].depth;
  }
  const bool known = std::any_of(depths.begin(), depths.end(),
                                 [](const auto& depth) { return depth.has_value(); });
  return known ? depths : PointDepths{};
}

}  // namespace

TwoViewEstimator::TwoViewEstimator(const FrontEndOptions& options,
                                   RelativePoseInitialiser::Ptr initialiser)
    : initialiser_(std::move(initialiser)),
      refine_(options.refine),
      refine_enabled_(options.refine_enabled),
      perspective_(options.perspective),
      threshold_px_(options.consensus.threshold_px),
      seed_(options.seed) {}

TwoView TwoViewEstimator::estimate(TrackedPair pair, const TwoViewPrior& prior) const {
  if (pair.standing) return standing(std::move(pair), prior.focal_px);
  std::vector<bool> told(pair.size(), true);
  bool whole = !creeps(prior.motion) || !take_the_sky_apart(pair, prior, told);
  TwoView result;
  CheckedAnswer answer = initialise(pair, told, prior, result.estimate_ms);
  if (whole && step_status(answer.result.status) == StepStatus::kNoMotion) {
    // That may turn a rest's rotation, but make no motion of it: traffic is below the sky, too.
    whole = !take_the_sky_apart(pair, prior, told);
    CheckedAnswer below = answer;
    if (!whole) below = initialise(pair, told, prior, result.estimate_ms);
    if (step_status(below.result.status) == StepStatus::kNoMotion) answer = std::move(below);
  }
  InitialiserResult& found = answer.result;
  result.fault = std::move(answer.fault);
  result.status = step_status(found.status);
  result.inlier_count = found.inlier_count;
  result.focal_px = prior.focal_px;
  result.pair = std::move(pair);
  if (result.status == StepStatus::kPredicted) {
    result.pose = with_unit_length(prior.expected);
    return result;
  }
  result.pose = found.pose;
  result.covariance = found.covariance;
  result.motion = found.motion;
  result.inliers = std::move(found.inliers);
  if (result.status == StepStatus::kOk) {
    result = in_lasting_sense(std::move(result), prior.motion.direction);
    result.set_inliers(with_plausible_depths(result.pair, result.inliers, result.pose, prior.motion,
                                             result.focal_px));
    result = in_lasting_sense(refined(std::move(result)), prior.motion.direction);
  }
  if (result.status == StepStatus::kOk && refine_enabled_) {
    result = in_likelier_basin(std::move(result), told, prior.course, refine_, threshold_px_);
  }
  if (!whole) result = with_the_sky(std::move(result), told, threshold_px_);
  const PointDepths depths = depths_of(result.pair, prior.depths);
  if (depths.empty()) return result;
  return creeping_by_depths(std::move(result), depths, prior, threshold_px_);
}

CheckedAnswer TwoViewEstimator::initialise(const TrackedPair& pair, const std::vector<bool>& told,
                                           const TwoViewPrior& prior, double& cpu_ms) const {
  const std::vector<AffineCorrespondence> acs = those_of(affine_parts(pair), told);
  const StageTimer timer(cpu_ms);
  CheckedAnswer answer = checked_answer(
      *initialiser_, {acs, prior.R_level_cam, prior.focal_px, seed_ + prior.number, prior.motion});
  std::vector<bool>& inliers = answer.result.inliers;
  if (acs.size() < told.size() && inliers.size() == acs.size()) inliers = among_all(inliers, told);
  return answer;
}

TwoView TwoViewEstimator::refined(TwoView start) const {
  if (perspective_) start.pair = corrected_for_perspective(start.pose, std::move(start.pair));
  if (!refine_enabled_) return start;
  RefineResult result;
  {
    const StageTimer timer(start.refine_ms);
    result = refine_two_view(affine_parts(start.pair), start.inliers, start.pose, start.focal_px,
                             refine_, {{}, point_sigmas(start.pair)});
  }
  if (!result.usable()) return start;
  start.pose = result.pose;
  const Matrix6 covariance = covariance_beside(result.information, result.pose.t);
  if (!covariance.isZero(0.0)) start.covariance = covariance;
  start.shared_covariance = result.shared_covariance;
  return start;
}

Matrix6 covariance_beside(const Matrix6& information, const Eigen::Vector3d& direction) {
  const double scale = information.trace() / 6.0;
  if (!(scale > 0.0) || !information.allFinite()) return Matrix6::Zero();
  Eigen::Matrix<double, 6, 1> along = Eigen::Matrix<double, 6, 1>::Zero();
  along.tail<3>() = direction.normalized();
  // A stiff spring along t makes it regular and adds nothing elsewhere.
  const Matrix6 regular = information + scale * along * along.transpose();
  const Matrix6 inverse = regular.ldlt().solve(Matrix6::Identity());
  const Matrix6 covariance = inverse - along * along.transpose() / scale;
  if (!covariance.allFinite()) return Matrix6::Zero();
  return 0.5 * (covariance + covariance.transpose());
}

}  // namespace oneac
