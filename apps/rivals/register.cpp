#include "rivals.h"

#include <mrpt/core/initializer.h>

#include <algorithm>

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(Rival, oneac::RelativePoseInitialiser, oneac::rivals)

namespace oneac::rivals {

void Rival::configure(const mrpt::containers::yaml&) {}

InitialiserResult Rival::answer(const RelativePose& pose, std::vector<bool> inliers,
                                std::size_t iterations) {
  InitialiserResult result;
  result.inlier_count = static_cast<std::size_t>(std::count(inliers.begin(), inliers.end(), true));
  result.inliers = std::move(inliers);
  result.statistics.iterations = iterations;
  const double length = pose.t.norm();
  if (!pose.is_finite() || !(length > 0.0)) return result;  // no pose
  result.pose = {pose.R, pose.t / length};
  result.status = PoseStatus::kOk;
  return result;
}

}  // namespace oneac::rivals

MRPT_INITIALIZER(register_rivals) {
  mrpt::rtti::registerClass(CLASS_ID(oneac::rivals::OpencvMagsac));
  mrpt::rtti::registerClass(CLASS_ID(oneac::rivals::OpencvRansac));
#ifdef ONEAC_WITH_OPENGV
  mrpt::rtti::registerClass(CLASS_ID(oneac::rivals::Opengv5pc));
#endif
}
