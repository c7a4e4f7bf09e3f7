#include "oneac/robust/degeneracy.h"

#include "degeneracy/one_plane.h"
#include "polish/pose_covariance.h"

#include "oneac/base/median.h"
#include "oneac/geometry/essential.h"
#include "oneac/geometry/leveling.h"
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

/// Most of the points must be explained for the camera to have stood; the rest may be traffic.
constexpr double kStandingShare = 0.8;
// The rotation of a pose with a wrong translation is off by the parallax it explains away: looked
// at more closely when its median shift is below so many bounds.
constexpr double kWorthAFit = 6.0;
// A glance at so many correspondences tells a moving camera: their median is not three times that
// of all.
constexpr std::size_t kGlance = 64;
constexpr double kClearlyAbove = 3.0;

/// Result when R alone leaves the points within the bounds.
std::optional<RobustResult> explained(AcSpan acs, const Eigen::Matrix3d& R,
                                      const DegeneracyBounds& bounds) {
  if (median_transfer_error(R, acs, kGlance) >= kClearlyAbove * bounds.standing_shift) {
    return std::nullopt;
  }
  const std::vector<double> errors = rotation_transfer_errors(R, acs);
  if (upper_median(errors) >= bounds.standing_shift) return std::nullopt;
  RobustResult result;
  result.pose.R = R;
  result.inliers.reserve(errors.size());
  for (double error : errors) result.inliers.push_back(error <= bounds.threshold);
  result.inlier_count =
      static_cast<std::size_t>(std::count(result.inliers.begin(), result.inliers.end(), true));
  const double needed = kStandingShare * static_cast<double>(acs.size());
  if (static_cast<double>(result.inlier_count) < needed) return std::nullopt;
  for (double error : errors) {
    const double ratio = error / bounds.threshold;
    result.cost += std::min(1.0, ratio * ratio);
  }
  return result;
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

std::optional<RobustResult> standing(AcSpan acs, const DegeneracyBounds& bounds) {
  auto result = explained(acs, Eigen::Matrix3d::Identity(), bounds);
  if (result) result->status = PoseStatus::kNoMotion;
  return result;
}

std::optional<RobustResult> turning(AcSpan acs, const Eigen::Matrix3d& R_start,
                                    const DegeneracyBounds& bounds) {
  if (median_transfer_error(R_start, acs, kGlance) >= kWorthAFit * bounds.standing_shift) {
    return std::nullopt;
  }
  const RotationFit fit = refine_rotation(R_start, acs, bounds.threshold);
  auto result = explained(acs, fit.R, bounds);
  if (!result) return std::nullopt;
  result->status = PoseStatus::kPureRotation;
  result->covariance.topLeftCorner<3, 3>() = fit.covariance;
  return result;
}

void conclude(const RelativePose& candidate, AcSpan acs, double threshold, RobustResult& result) {
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

void settle_one_plane(AcSpan acs, const Eigen::Matrix3d& R_level_cam, double threshold,
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
  conclude(*twin, acs, threshold, other);
  // Polishing may lose the twin where the points leave it no basin of its own.
  if (other.inlier_count * 10 >= result.inlier_count * 9) result = other;
}

}  // namespace oneac
