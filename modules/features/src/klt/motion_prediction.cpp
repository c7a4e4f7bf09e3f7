#include "motion_prediction.h"

#include "oneac/geometry/homography.h"

#include <Eigen/Geometry>

namespace oneac::internal {
namespace {

// Road farther than this [camera heights] moves like what is far away, and its patches are seen so
// flat that the plane predicts nothing.
constexpr double kRoadReach = 40.0;
// [px] A point that missed the way of the scene by more moves by itself.
constexpr double kOwnWay = 1.5;
// [px] Nearer to the point that it moves away from, a point tells no depth.
constexpr double kBlind = 3.0;
constexpr double kBehind = 0.1;  // [-] depth after over depth before

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
  if (hint.T_2_1 && hint.T_2_1->is_finite()) set_motion(*hint.T_2_1, hint.scaled);
}

void MotionPrediction::set_motion(const RelativePose& motion, bool scaled) {
  motion_ = motion;
  far_ = motion.R;
  if (scaled) road_ = plane_induced_homography(motion, {down_, 1.0});
}

MotionPrediction MotionPrediction::corrected(const MotionCorrection& correction) const {
  MotionPrediction result = *this;
  if (!motion_) return result;
  const Eigen::Matrix3d turn = rotation_from_vector(correction.turn);
  result.set_motion({turn * motion_->R, (1.0 + correction.speed) * (turn * motion_->t)},
                    is_metric());
  return result;
}

std::optional<ExpectedPlace> MotionPrediction::goes_on(const Eigen::Vector2d& u0,
                                                       const Eigen::Vector2d& u1) const {
  if (!motion_) return std::nullopt;
  const Eigen::Vector3d &t = motion_->t, turned = motion_->R * camera_.normalise(u0).homogeneous();
  const Eigen::Vector2d x = camera_.normalise(u1);
  const double focal = camera_.focal_px(), blind = t.norm() * kBlind / focal;
  // ρ (t₁₂ − x t₃) = turned₃ (x − turned₁₂ / turned₃), ρ the inverse depth in the view of u0.
  const Eigen::Vector2d along = t.head<2>() - t.z() * x;
  const Eigen::Vector2d way = turned.z() * x - turned.head<2>();
  const double regular = along.squaredNorm() + blind * blind;
  const double inverse = regular > 0.0 ? way.dot(along) / regular : 0.0;
  const double depth = turned.z() + inverse * t.z();
  if (!((way - inverse * along).norm() * focal <= kOwnWay * depth) || depth < kBehind) {
    return std::nullopt;
  }
  const Eigen::Vector3d far = motion_->R * x.homogeneous();
  const Eigen::Vector3d near = far + (inverse / depth) * t;
  if (near.z() < kBehind || far.z() < kBehind) return std::nullopt;
  const Eigen::Vector2d u = camera_.project(near.hnormalized());
  return ExpectedPlace{u, u - camera_.project(far.hnormalized())};
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
