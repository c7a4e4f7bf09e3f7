#include "two_view.h"

#include "perspective_correction.h"

#include "oneac/base/thread_clock.h"
#include "oneac/frontend/front_end_options.h"

#include <Eigen/Cholesky>

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

}  // namespace

TwoViewEstimator::TwoViewEstimator(const FrontEndOptions& options,
                                   RelativePoseInitialiser::Ptr initialiser)
    : initialiser_(std::move(initialiser)),
      refine_(options.refine),
      refine_enabled_(options.refine_enabled),
      perspective_(options.perspective),
      seed_(options.seed) {}

TwoView TwoViewEstimator::estimate(TrackedPair pair, const TwoViewPrior& prior) const {
  if (pair.standing) return standing(std::move(pair), prior.focal_px);
  TwoView result;
  CheckedAnswer answer = initialise(pair, prior, result.estimate_ms);
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
  return result.status == StepStatus::kOk ? refined(std::move(result)) : result;
}

CheckedAnswer TwoViewEstimator::initialise(const TrackedPair& pair, const TwoViewPrior& prior,
                                           double& cpu_ms) const {
  const std::vector<AffineCorrespondence> acs = affine_parts(pair);
  const StageTimer timer(cpu_ms);
  return checked_answer(
      *initialiser_, {acs, prior.R_level_cam, prior.focal_px, seed_ + prior.number, prior.motion});
}

TwoView TwoViewEstimator::refined(TwoView start) const {
  if (perspective_) start.pair = corrected_for_perspective(start.pose, std::move(start.pair));
  if (!refine_enabled_) return start;
  RefineResult result;
  {
    const StageTimer timer(start.refine_ms);
    result = refine_two_view(affine_parts(start.pair), start.inliers, start.pose, start.focal_px,
                             refine_);
  }
  if (!result.usable()) return start;
  start.pose = result.pose;
  const Matrix6 covariance = covariance_beside(result.information, result.pose.t);
  if (!covariance.isZero(0.0)) start.covariance = covariance;
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
