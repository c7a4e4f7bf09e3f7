#include "motion_prediction.h"

#include "oneac/geometry/homography.h"

#include <Eigen/Geometry>

namespace oneac::internal {
namespace {

// Road farther than this [camera heights] moves like what is far away, and its patches are seen so
// flat that the plane predicts nothing.
constexpr double kRoadReach = 40.0;

std::optional<PatchWarp> map(const Eigen::Matrix3d& H, const PinholeCamera& camera,
                             const Eigen::Vector2d& u1) {
  const auto ac = correspondence_from_homography(H, camera.normalise(u1));
  if (!ac) return std::nullopt;
  PatchWarp warp;
  warp.centre = camera.project(ac->x2);
  const Eigen::Vector2d f(camera.fx, camera.fy);
  warp.M = f.asDiagonal() * ac->A * f.cwiseInverse().asDiagonal();
  if (!(warp.M.determinant() > 0.0)) return std::nullopt;
  return warp;
}

}  // namespace

MotionPrediction::MotionPrediction(const MotionHint& hint)
    : camera_(hint.camera), down_(hint.R_level_cam.transpose().col(1)) {
  if (!hint.T_2_1 || !hint.T_2_1->is_finite()) return;
  far_ = hint.T_2_1->R;
  if (hint.scaled) road_ = plane_induced_homography(*hint.T_2_1, {down_, 1.0});
}

std::optional<PatchWarp> MotionPrediction::far_away(const Eigen::Vector2d& u1) const {
  return far_ ? map(*far_, camera_, u1) : std::nullopt;
}

std::optional<PatchWarp> MotionPrediction::on_road(const Eigen::Vector2d& u1) const {
  if (!road_) return std::nullopt;
  if (down_.dot(camera_.normalise(u1).homogeneous().eval()) * kRoadReach < 1.0) return std::nullopt;
  return map(*road_, camera_, u1);
}

}  // namespace oneac::internal
