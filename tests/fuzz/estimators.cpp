// The robust estimators on any doubles, small budgets: no NaN, counts agree.
#include "correspondences.h"

#include "oneac/geometry/levelling.h"
#include "oneac/robust/gc_ransac.h"
#include "oneac/robust/ground_scale.h"
#include "oneac/robust/one_ac_consensus.h"
#include "oneac/solvers/registry.h"

#include <algorithm>
#include <cmath>

namespace {

using namespace oneac;

void check_inliers(const std::vector<bool>& inliers, std::size_t count, std::size_t acs) {
  fuzz::check(inliers.size() == acs, "a flag per correspondence");
  const auto set = static_cast<std::size_t>(std::count(inliers.begin(), inliers.end(), true));
  fuzz::check(set == count, "the number of inliers");
}

void check_result(const RobustResult& result, std::size_t acs) {
  fuzz::check_pose(result.pose);
  fuzz::check(result.covariance.allFinite(), "a covariance is finite");
  fuzz::check(result.cost >= 0.0 && result.cost <= static_cast<double>(acs), "the cost's bounds");
  check_inliers(result.inliers, result.inlier_count, acs);
  if (!has_direction(result.status)) return;
  fuzz::check(std::abs(result.pose.t.norm() - 1.0) < 1e-6, "a direction has length one");
}

void check_scale(AcSpan acs, const RobustResult& result, const Eigen::Matrix3d& R_level_cam) {
  constexpr double kSigma = 1e-3;
  if (!has_direction(result.status)) return;
  const auto scale = ground_scale(acs, result.inliers, result.pose, R_level_cam, kSigma, {});
  if (scale) fuzz::check(std::isfinite(scale->baseline) && scale->baseline >= 0.0, "a length");
}

ConsensusOptions small_consensus(std::uint8_t kinds) {
  ConsensusOptions options;
  options.minimal_problems = 100;
  options.modes = 4;
  options.finalists = 2;
  options.min_inliers = 5;
  options.pool["side_wall"] = (kinds & 1U) != 0;
  options.pool["front_wall"] = (kinds & 2U) != 0;
  options.pool["wall"] = (kinds & 4U) != 0;
  options.pool["planar"] = (kinds & 8U) == 0;
  return options;
}

GcRansacOptions small_gc_ransac() {
  GcRansacOptions options;
  options.max_iterations = 20;
  options.min_iterations = 5;
  options.lo_iterations = 2;
  options.min_inliers = 5;
  return options;
}

}  // namespace

ONEAC_FUZZ_TARGET(estimators) {
  constexpr std::size_t kMost = 48;
  constexpr double kFocal_px = 700.0;
  fuzz::Numbers numbers(data);
  const std::uint8_t kinds = numbers.byte();
  const Solver& solver = solvers()[numbers.byte() % solvers().size()];
  const std::size_t count = numbers.byte() % kMost;
  const Eigen::Matrix3d R_level_cam = levelling_rotation({0.1, 0.02});
  const auto acs = fuzz::correspondences(numbers, count);

  const auto consensus = one_ac_consensus(acs, R_level_cam, kFocal_px, small_consensus(kinds));
  check_result(consensus, count);
  check_scale(acs, consensus, R_level_cam);
  const auto ransac = gc_ransac(acs, R_level_cam, kFocal_px, solver, 1, small_gc_ransac());
  check_result(ransac, count);
  check_scale(acs, ransac, R_level_cam);
}
