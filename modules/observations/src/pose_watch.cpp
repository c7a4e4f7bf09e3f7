#include "oneac/observations/pose_watch.h"

#include "oneac/base/error.h"
#include "oneac/geometry/angles.h"

namespace oneac {
namespace {

// Less is the noise of a pose that somebody estimates on line.
constexpr double kSamePlace = 0.01;               // [m]
constexpr double kSameDirection = 0.5 * kDegree;  // [rad]

bool is_same(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::Isometry3d off = a.inverse() * b;
  return off.translation().norm() < kSamePlace &&
         Eigen::AngleAxisd(off.linear()).angle() < kSameDirection;
}

}  // namespace

void PoseWatch::check(const CameraView& view, const std::string& where) {
  constexpr std::size_t kRemembered = 3;
  const Eigen::Isometry3d& now = view.T_vehicle_sensor;
  const bool alternates = last_.size() == kRemembered && !is_same(last_[2], now) &&
                          is_same(last_[1], now) && is_same(last_[0], last_[2]);
  if (alternates) {
    throw InputError(where,
                     "the pose of camera '" + view.name() +
                         "' goes back and forth with every image: two cameras have one label",
                     "give each camera a label of its own with rawlog-edit");
  }
  last_.push_back(now);
  if (last_.size() > kRemembered) last_.erase(last_.begin());
}

}  // namespace oneac
