#include "oneac/robust/degeneracy.h"

#include "degeneracy/one_plane.h"
#include "polish/pose_covariance.h"

#include "oneac/base/median.h"
#include "oneac/geometry/essential.h"
#include "oneac/geometry/levelling.h"
#include "oneac/geometry/triangulation.h"
#include "oneac/robust/point_set.h"
#include "oneac/robust/polish.h"
#include "oneac/robust/rotation_only.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace oneac {
namespace {

// The rotation of a pose with a wrong translation is off by the parallax it explains away: looked
// at more closely when its median shift is below so many bounds.
constexpr double kWorthAFit = 6.0;
// A glance at so many correspondences tells a moving camera: their median is not three times that
// of all.
constexpr std::size_t kGlance = 64;
constexpr double kClearlyAbove = 3.0;

// What stands below the horizon asks for a closer look: a fifth of so many points is more than the
// vehicle ahead and drops on the glass give.
constexpr double kStandingBelow = 0.2;
constexpr std::size_t kFewestBelow = 8;
constexpr double kBelow = 0.05;  // [rad] under the horizon, three degrees
// The noise of a coordinate is a quarter of an inlier's bound: what trackers reach, with a reserve.
constexpr double kBoundOverSigma = 4.0;

/// Whether R alone may explain most points.
bool is_nearly_explained(AcSpan acs, const Eigen::Matrix3d& R, double standing_shift) {
  if (median_transfer_error(R, acs, kGlance) >= kClearlyAbove * standing_shift) return false;
  return upper_median(rotation_transfer_errors(R, acs)) < standing_shift;
}

/// Whether more of the near points keep their place than a moving camera sees.
bool stands_below(AcSpan acs, const DegeneracyBounds& bounds) {
  const std::size_t step = std::max<std::size_t>(1, acs.size() / (4 * kGlance));
  std::size_t below = 0;
  std::size_t standing = 0;
  for (std::size_t i = 0; i < acs.size(); i += step) {
    if (bounds.R_level_cam.row(1).dot(acs[i].x1.homogeneous()) < kBelow) continue;
    ++below;
    if ((acs[i].x2 - acs[i].x1).squaredNorm() < bounds.threshold * bounds.threshold) ++standing;
  }
  return below >= kFewestBelow &&
         static_cast<double>(standing) > kStandingBelow * static_cast<double>(below);
}

/// The answer of a camera that stayed in its place.
RobustResult at_rest(AcSpan acs, const MotionEvidence& evidence, double threshold) {
  RobustResult result;
  result.status =
      evidence.model == MotionModel::kStill ? PoseStatus::kNoMotion : PoseStatus::kPureRotation;
  result.pose.R = evidence.pose.R;
  result.motion = evidence;
  result.inliers.reserve(acs.size());
  for (const double error : rotation_transfer_errors(result.pose.R, acs)) {
    const double ratio = error / threshold;
    result.inliers.push_back(ratio <= 1.0);
    result.inlier_count += ratio <= 1.0 ? 1 : 0;
    result.cost += std::min(1.0, ratio * ratio);
  }
  return result;
}

MotionEvidence judged(AcSpan acs, const MotionHypotheses& hypotheses,
                      const DegeneracyBounds& bounds) {
  MotionEvidenceOptions options;
  options.sigma = bounds.threshold / kBoundOverSigma;
  return judge_motion(acs, {}, hypotheses, bounds.R_level_cam, bounds.prior, options);
}

double cost_of(AcSpan acs, const Eigen::Matrix3d& R, double threshold) {
  double cost = 0.0;
  for (const double error : rotation_transfer_errors(R, acs)) {
    cost += std::min(1.0, error * error / (threshold * threshold));
  }
  return cost;
}

/// The rotation that explains more: near that of a motion, or near none.
RotationFit rest_rotation(AcSpan acs, const Eigen::Matrix3d& R_start, double threshold) {
  const RotationFit near_pose = refine_rotation(R_start, acs, threshold);
  const RotationFit near_none = refine_rotation(Eigen::Matrix3d::Identity(), acs, threshold);
  return cost_of(acs, near_pose.R, threshold) < cost_of(acs, near_none.R, threshold) ? near_pose
                                                                                     : near_none;
}

// Inliers that vote on the sign of t; each is right unless it is far away, and then undecided.
constexpr std::size_t kVoters = 128;

/// t or −t, whichever puts more of some evenly spaced inliers before both cameras.
RelativePose with_forward_sign(const RelativePose& pose, AcSpan acs, const RobustResult& found) {
  const std::size_t every = std::max<std::size_t>(1, found.inlier_count / kVoters);
  int votes = 0;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (found.inliers[i] && seen++ % every == 0) votes += cheirality(pose, acs[i].x1, acs[i].x2);
  }
  return votes < 0 ? RelativePose{pose.R, -pose.t} : pose;
}

/// How far a motion is from that of a vehicle on a plane [rad]: the turn of its vertical axis and
/// the climb of its translation.
double distance_from_planar(const RelativePose& pose, const Eigen::Matrix3d& R_level_cam) {
  const RelativePose levelled = level(pose, R_level_cam);
  return std::acos(std::clamp(levelled.R(1, 1), -1.0, 1.0)) +
         std::asin(std::min(1.0, std::abs(levelled.t.y())));
}

}  // namespace

std::optional<RobustResult> find_standing(AcSpan acs, const DegeneracyBounds& bounds) {
  if (!is_nearly_explained(acs, Eigen::Matrix3d::Identity(), bounds.standing_shift)) {
    return std::nullopt;
  }
  const MotionEvidence evidence = judged(acs, {}, bounds);
  if (evidence.model != MotionModel::kStill) return std::nullopt;
  return at_rest(acs, evidence, bounds.threshold);
}

MotionDecision resting_or_moving(AcSpan acs, const RelativePose& candidate,
                                 const DegeneracyBounds& bounds) {
  MotionDecision decision;
  decision.moving = candidate;
  if (median_transfer_error(candidate.R, acs, kGlance) >= kWorthAFit * bounds.standing_shift &&
      !stands_below(acs, bounds)) {
    return decision;
  }
  const RotationFit fit = rest_rotation(acs, candidate.R, bounds.threshold);
  const MotionEvidence evidence = judged(acs, {fit.R, {candidate}}, bounds);
  decision.evidence = evidence;
  if (evidence.model == MotionModel::kTranslation) {
    // The sense of a candidate is decided after polishing, as it stands.
    if (evidence.pose.R != candidate.R) decision.moving = evidence.pose;
    return decision;
  }
  decision.resting = at_rest(acs, evidence, bounds.threshold);
  if (evidence.model == MotionModel::kRotation) {
    decision.resting->covariance.topLeftCorner<3, 3>() = fit.covariance;
  }
  return decision;
}

void complete_result(const RelativePose& candidate, AcSpan acs, double threshold,
                     RobustResult& result) {
  PolishOptions options;
  options.threshold = threshold;
  options.starts_near = true;  // the candidate was polished in single precision
  const PolishResult polished = polish(candidate, PrecisePointSet(acs), options);
  const Eigen::Matrix3d E = essential_matrix(polished.pose);
  result.inliers.assign(acs.size(), false);
  result.cost = 0.0;
  result.inlier_count = 0;
  double squares = 0.0;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    const double r = sampson_distance(E, acs[i].x1, acs[i].x2);
    result.inliers[i] = std::abs(r) <= threshold;
    result.cost += std::min(1.0, r * r / (threshold * threshold));
    if (!result.inliers[i]) continue;
    ++result.inlier_count;
    squares += r * r;
  }
  result.pose = with_forward_sign(polished.pose, acs, result);
  result.covariance = internal::pose_covariance(polished, result, squares);
}

void resolve_one_plane(AcSpan acs, const Eigen::Matrix3d& R_level_cam, double threshold,
                       RobustResult& result) {
  const auto plane = internal::common_plane(result.pose, acs, result.inliers, threshold);
  if (!plane) return;
  result.status = PoseStatus::kOnePlane;
  const auto twin = internal::twin_pose(result.pose, *plane, acs, result.inliers);
  if (!twin ||
      distance_from_planar(*twin, R_level_cam) >= distance_from_planar(result.pose, R_level_cam)) {
    return;
  }
  RobustResult other = result;
  complete_result(*twin, acs, threshold, other);
  // Polishing may lose the twin where the points leave it no basin of its own.
  if (other.inlier_count * 10 >= result.inlier_count * 9) result = other;
}

}  // namespace oneac
