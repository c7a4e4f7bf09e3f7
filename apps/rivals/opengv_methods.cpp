#include "rivals.h"

#include <opengv/relative_pose/CentralRelativeAdapter.hpp>
#include <opengv/relative_pose/methods.hpp>
#include <opengv/sac/Ransac.hpp>
#include <opengv/sac_problems/relative_pose/CentralRelativePoseSacProblem.hpp>

#include <cmath>
#include <memory>

IMPLEMENTS_MRPT_OBJECT(Opengv5pc, oneac::rivals::Rival, oneac::rivals)

namespace oneac::rivals {
namespace {

using Problem = opengv::sac_problems::relative_pose::CentralRelativePoseSacProblem;
using Transformation = opengv::transformation_t;
constexpr std::size_t kFewest = 8;  // five of the solver, three to choose among its solutions

opengv::bearingVector_t bearing(const Eigen::Vector2d& x) {
  return x.homogeneous().normalized();
}

/// OpenGV maps points of the second camera to the first.
RelativePose to_pose(const Transformation& T_1_2) {
  const RelativePose pose{T_1_2.leftCols<3>(), T_1_2.col(3)};
  return pose.inverse();
}

}  // namespace

InitialiserResult Opengv5pc::estimate(const InitialiserInput& input) const {
  std::vector<bool> inliers(input.acs.size(), false);
  const RelativePose none;  // t = 0: no pose
  if (input.acs.size() < kFewest) return answer(none, std::move(inliers), 0);
  opengv::bearingVectors_t first, second;
  for (const AffineCorrespondence& ac : input.acs) {
    first.push_back(bearing(ac.x1));
    second.push_back(bearing(ac.x2));
  }
  opengv::relative_pose::CentralRelativeAdapter adapter(first, second);
  const auto problem = std::make_shared<Problem>(adapter, Problem::STEWENIUS, false);
  problem->rng_alg_.seed(static_cast<unsigned>(input.seed));
  opengv::sac::Ransac<Problem> ransac;
  ransac.sac_model_ = problem;
  ransac.threshold_ = 1.0 - std::cos(std::atan(kThreshold_px / input.focal_px));
  ransac.max_iterations_ = kMostIterations;
  ransac.probability_ = kConfidence;
  if (!ransac.computeModel(0)) return answer(none, std::move(inliers), 0);
  Transformation refined;
  problem->optimizeModelCoefficients(ransac.inliers_, ransac.model_coefficients_, refined);
  for (const int i : ransac.inliers_) inliers[static_cast<std::size_t>(i)] = true;
  return answer(to_pose(refined), std::move(inliers), static_cast<std::size_t>(ransac.iterations_));
}

}  // namespace oneac::rivals
