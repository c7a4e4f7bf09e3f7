#include "sense_of_travel.h"

#include "oneac/geometry/triangulation.h"

#include <cmath>
#include <cstddef>

namespace oneac {
namespace {

/// Whether more inliers lie before both cameras than would by chance.
bool is_sure_of_its_sense(const TwoView& found) {
  constexpr double kSure = 3.0;  // [σ]
  double votes = 0.0, voters = 0.0;
  for (std::size_t i = 0; i < found.pair.size(); ++i) {
    if (!found.inliers[i]) continue;
    const Correspondence& ac = found.pair.correspondences[i];
    const int vote = cheirality(found.pose, ac.x1, ac.x2);
    votes += vote;
    voters += vote != 0 ? 1.0 : 0.0;
  }
  return votes > kSure * std::sqrt(voters);
}

}  // namespace

TwoView in_lasting_sense(TwoView found, const Eigen::Vector3d& heading) {
  if (found.status != StepStatus::kOk || !(found.pose.t.dot(heading) < 0.0)) return found;
  if (is_sure_of_its_sense(found)) return found;
  found.pose.t = -found.pose.t;
  for (auto* covariance : {&found.covariance, &found.shared_covariance}) {
    covariance->topRightCorner<3, 3>() *= -1.0;
    covariance->bottomLeftCorner<3, 3>() *= -1.0;
  }
  return found;
}

}  // namespace oneac
