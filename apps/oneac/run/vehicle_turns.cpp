#include "vehicle_turns.h"

#include <Eigen/Geometry>

namespace oneac::app {

double turn_about_upright(const Trajectory& vehicle, std::size_t i) {
  if (i == 0) return 0.0;
  const Eigen::Matrix3d R = vehicle.poses[i - 1].linear().transpose() * vehicle.poses[i].linear();
  const Eigen::AngleAxisd turned(R);
  return turned.angle() * turned.axis().z();
}

GyroscopeHeading heading_by_gyroscope(const std::vector<ImuSample>& samples, int axis) {
  GyroscopeHeading heading;
  for (const ImuSample& sample : samples) {
    if (sample.angular_rate) heading.add(sample.time_s, (*sample.angular_rate)[axis]);
  }
  return heading;
}

}  // namespace oneac::app
