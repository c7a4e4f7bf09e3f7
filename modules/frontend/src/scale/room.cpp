#include "room.h"

#include "oneac/geometry/triangulation.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace oneac {

double room_beside(AcSpan acs, const std::vector<bool>& inliers, const RelativePose& T_2_1) {
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  constexpr double kOnTheWay = 0.1;  // share of what is seen
  const Eigen::Vector3d along = (T_2_1.R.transpose() * T_2_1.t).normalized();
  std::vector<double> room;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (!inliers[i]) continue;
    const auto point = triangulate(T_2_1, acs[i].x1, acs[i].x2);
    const bool near = point && point->in_front();
    room.push_back(near ? (point->z1 * acs[i].x1.homogeneous()).cross(along).norm() : kUnbounded);
  }
  if (room.empty()) return kUnbounded;
  const auto tenth = static_cast<std::ptrdiff_t>(kOnTheWay * static_cast<double>(room.size()));
  std::nth_element(room.begin(), room.begin() + tenth, room.end());
  return room[static_cast<std::size_t>(tenth)];
}

}  // namespace oneac
