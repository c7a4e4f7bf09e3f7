#include "stereo_travel.h"

#include "length_votes.h"

#include <Eigen/Geometry>

#include <cmath>
#include <vector>

namespace oneac {
namespace {

// [σ] A point farther from its epipolar line has a motion of its own.
constexpr double kOff = 3.0;
// [-] of the points that must agree: fewer may be a car that crosses near by.
constexpr double kMajority = 0.5;
// [m] what a common error of rotation and tracks leaves at a standstill.
constexpr double kLeastSigma = 0.003;

// [m] Bonnet, wipers and mirrors are nearer, and rest at any speed: the longest bonnet ends 2.5 m
// before a camera behind the windscreen.
constexpr double kCarEnds = 3.0;

/// Distance of x2 from the epipolar line of x1 [-].
double off_line(const RelativePose& unit_step, const Correspondence& ac) {
  const Eigen::Vector3d line = unit_step.t.cross(unit_step.R * ac.x1.homogeneous());
  const double norm = line.head<2>().norm();
  return norm > 0.0 ? std::abs(line.dot(ac.x2.homogeneous())) / norm : 0.0;
}

/// @param nearest  [m] depth of the points that vote
std::vector<LengthVote> votes_of(const TwoView& seen, const RelativePose& unit_step,
                                 double nearest) {
  const RelativePose back = unit_step.inverse();
  std::vector<LengthVote> votes;
  for (std::size_t i = 0; i < seen.pair.size(); ++i) {
    const Correspondence& ac = seen.pair.correspondences[i];
    if (!ac.depth || ac.depth->z < nearest) continue;
    if (i < seen.inliers.size() && !seen.inliers[i]) continue;
    const double sigma = point_sigma(ac, seen.focal_px);
    if (off_line(unit_step, ac) > kOff * sigma) continue;
    const Eigen::Vector3d X = ac.depth->z * ac.x2.homogeneous();
    const auto vote = length_vote(back, X, ac.x1, ac.depth->sigma, sigma);
    if (vote && std::isfinite(vote->length)) votes.push_back(*vote);
  }
  return votes;
}

}  // namespace

std::optional<MeasuredTravel> stereo_travel(const TwoView& seen, const Eigen::Vector3d& heading,
                                            std::size_t least) {
  const bool directed = seen.status == StepStatus::kOk && seen.pose.t.norm() > 0.0;
  const RelativePose unit_step{seen.pose.R, directed ? seen.pose.t.normalized() : heading};
  if (!unit_step.is_finite() || !(unit_step.t.norm() > 0.0)) return std::nullopt;
  const std::vector<LengthVote> votes = votes_of(seen, unit_step, directed ? 0.0 : kCarEnds);
  if (votes.empty() || votes.size() < least) return std::nullopt;
  const RobustMean mean = robust_mean(votes);
  const double agreeing = static_cast<double>(mean.support);
  if (mean.support < least || agreeing < kMajority * static_cast<double>(votes.size()) ||
      !std::isfinite(mean.value)) {
    return std::nullopt;
  }
  const double length = std::abs(mean.value);
  const double scatter = std::max(mean.relative_sigma * length, kLeastSigma);
  const double common = std::hypot(mean.depth_sigma * length, mean.lever.norm() * kTurnSigma);
  return MeasuredTravel{directed ? mean.value : length, std::hypot(scatter, common),
                        LengthSource::kStereo, true};
}

}  // namespace oneac
