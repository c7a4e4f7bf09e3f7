#include "read/action_odometry.h"

#include <mrpt/obs/CActionRobotMovement2D.h>

#include <cmath>

namespace oneac {

mrpt::obs::CObservationOdometry::Ptr ActionOdometry::take(mrpt::obs::CActionCollection& actions) {
  using mrpt::obs::CActionRobotMovement2D;
  const auto movement = actions.getMovementEstimationByType(CActionRobotMovement2D::emOdometry);
  if (!movement) return nullptr;
  const mrpt::poses::CPose2D& step = movement->rawOdometryIncrementReading;
  if (!std::isfinite(step.x()) || !std::isfinite(step.y()) || !std::isfinite(step.phi())) {
    pose_ = mrpt::poses::CPose2D();
    return nullptr;
  }
  pose_ = pose_ + step;
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->timestamp = movement->timestamp;
  odometry->sensorLabel = "ACTIONS";
  odometry->odometry = pose_;
  return odometry;
}

}  // namespace oneac
