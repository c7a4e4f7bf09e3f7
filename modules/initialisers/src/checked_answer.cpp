#include "oneac/initialisers/checked_answer.h"

#include "oneac/base/error.h"
#include "oneac/base/printable.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>

namespace oneac {
namespace {

constexpr double kRotation = 1e-3;  // as files of poses are read
constexpr double kLength = 1e-3;
constexpr std::size_t kLongest = 200;                     // [byte] of what a stranger throws
constexpr std::uint64_t kMost = std::uint64_t{1} << 40U;  // of anything that is counted

bool is_known(PoseStatus status) {
  switch (status) {
    case PoseStatus::kOk:
    case PoseStatus::kOnePlane:
    case PoseStatus::kPureRotation:
    case PoseStatus::kNoMotion:
    case PoseStatus::kTooFew:
      return true;
  }
  return false;
}

bool is_rotation(const Eigen::Matrix3d& R) {
  if (!R.allFinite() || R.cwiseAbs().maxCoeff() > 1.0 + kRotation) return false;
  const Eigen::Matrix3d off = R * R.transpose() - Eigen::Matrix3d::Identity();
  return off.cwiseAbs().maxCoeff() < kRotation && R.determinant() > 0.0;
}

std::string fault_of_pose(const InitialiserResult& answer) {
  if (!is_rotation(answer.pose.R)) return "its R is no rotation";
  const Eigen::Vector3d& t = answer.pose.t;
  if (!t.allFinite()) return "its t is not finite";
  const double length = has_direction(answer.status) ? 1.0 : 0.0;
  if (std::abs(t.stableNorm() - length) > kLength) {
    return std::string("its t has not the length ") + (length > 0.0 ? "1" : "0") +
           " that goes with its status";
  }
  const double turn = (answer.pose.R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (answer.status == PoseStatus::kNoMotion && turn > kRotation) {
    return "it says no motion, and its R turns";
  }
  return "";
}

bool is_counted(const RobustStatistics& statistics) {
  for (const std::size_t count : {statistics.iterations, statistics.hypotheses,
                                  statistics.local_optimisations, statistics.graph_cuts}) {
    if (count >= kMost) return false;
  }
  return true;
}

std::string fault_of_inliers(const InitialiserResult& answer, std::size_t acs) {
  const std::vector<bool>& inliers = answer.inliers;
  if (inliers.size() != acs) {
    return "it has " + std::to_string(inliers.size()) + " inlier flags for " + std::to_string(acs) +
           " correspondences";
  }
  const auto set = std::count(inliers.begin(), inliers.end(), true);
  if (answer.inlier_count == static_cast<std::size_t>(set)) return "";
  return "it counts " + std::to_string(answer.inlier_count) + " inliers and flags " +
         std::to_string(set);
}

bool is_finite(const MotionEvidence& evidence) {
  return !std::isnan(evidence.log_odds) && !std::isnan(evidence.rotation_odds) &&
         evidence.pose.is_finite() && evidence.direction.allFinite() &&
         std::isfinite(evidence.length) && evidence.length_sigma >= 0.0;
}

}  // namespace

std::string fault_of_answer(const InitialiserResult& answer, std::size_t acs) {
  if (!is_known(answer.status)) return "its status is none";
  if (answer.motion && !is_finite(*answer.motion)) return "its evidence of motion is not finite";
  if (!is_counted(answer.statistics)) return "its statistics count more than can be";
  if (answer.inlier_count > acs) {
    return "it counts " + std::to_string(answer.inlier_count) + " inliers of " +
           std::to_string(acs) + " correspondences";
  }
  if (answer.status == PoseStatus::kTooFew) return "";
  if (!std::isfinite(answer.cost) || !answer.covariance.allFinite()) {
    return "its cost or covariance is not finite";
  }
  const std::string pose = fault_of_pose(answer);
  return pose.empty() ? fault_of_inliers(answer, acs) : pose;
}

std::string told(const std::exception& error) {
  return shortened(printable(error.what()), kLongest);
}

void configure_checked(RelativePoseInitialiser& initialiser,
                       const mrpt::containers::yaml& parameters) {
  constexpr const char* kCure = "check its parameters, or leave the method out";
  std::string name = "initialiser";
  try {
    name += " '" + initialiser.name() + "'";
    initialiser.configure(parameters);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(name, "its configure() threw: " + told(error), kCure);
  } catch (...) {
    throw InputError(name, "its configure() threw", kCure);
  }
}

CheckedAnswer checked_answer(const RelativePoseInitialiser& initialiser,
                             const InitialiserInput& input) {
  CheckedAnswer answer;
  try {
    answer.result = initialiser.estimate(input);
    answer.fault = fault_of_answer(answer.result, input.acs.size());
  } catch (const std::exception& error) {
    answer.fault = "it threw: " + told(error);
  } catch (...) {
    answer.fault = "it threw";
  }
  if (!answer.fault.empty()) answer.result = {};
  return answer;
}

}  // namespace oneac
