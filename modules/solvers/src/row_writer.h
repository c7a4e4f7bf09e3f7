#pragma once

#include "oneac/solvers/homography_decomposition.h"
#include "oneac/solvers/registry.h"
#include "oneac/solvers/relpose_1ac_planar_pitch.h"
#include "oneac/solvers/relpose_1ac_vertical.h"
#include "oneac/solvers/wall_pose.h"

#include <cstddef>
#include <cstdint>

namespace oneac::internal {

inline PlanePose with_plane(const PlanarPose& s) {
  return {s.pose(), Eigen::Vector3d::UnitY()};
}
inline PlanePose with_plane(const WallPose& s) {
  return {s.pose(), s.normal()};
}
inline PlanePose with_plane(const PitchedPose& s) {
  return {s.pose(), Eigen::Vector3d::UnitY()};
}
inline PlanePose with_plane(const UprightPose& s) {
  return {s.pose(), Eigen::Vector3d::UnitY()};
}
inline PlanePose with_plane(const RelativePose& T) {
  return {T, Eigen::Vector3d::UnitY()};
}

/// Writes solutions row after row, their numbers straight from what they hold: with_plane() by way
/// of matrices costs half as much as the fastest solvers.
class RowWriter {
 public:
  explicit RowWriter(const PoseRows& out)
      : R_(out.R), t_(out.t), n_(out.n), count_(out.count), room_(out.room) {}

  void add(const PlanarPose& s) {
    if (!has_room()) return;
    yaw(s.cos_alpha, s.sin_alpha);
    put(t_, s.tx, 0.0, s.tz);
    put(n_, 0.0, 1.0, 0.0);
  }
  void add(const WallPose& s) {
    if (!has_room()) return;
    yaw(s.cos_alpha, s.sin_alpha);
    put(t_, s.tx, 0.0, s.tz);
    put(n_, s.nx, 0.0, s.nz);
  }
  void add(const UprightPose& s) {
    if (!has_room()) return;
    yaw(s.cos_alpha, s.sin_alpha);
    put(t_, s.t.x(), s.t.y(), s.t.z());
    put(n_, 0.0, 1.0, 0.0);
  }
  void add(const PitchedPose& s) { add(with_plane(s)); }
  void add(const RelativePose& s) { add(with_plane(s)); }
  void add(const PlanePose& s) {
    if (!has_room()) return;
    const Eigen::Matrix3d& R = s.motion.R;
    for (Eigen::Index row = 0; row < 3; ++row) put(R_, R(row, 0), R(row, 1), R(row, 2));
    put(t_, s.motion.t.x(), s.motion.t.y(), s.motion.t.z());
    put(n_, s.n.x(), s.n.y(), s.n.z());
  }

  /// No motion in the room that is left; the next solution is the next sample's.
  void finish_sample() {
    *count_++ = static_cast<std::int64_t>(used_);
    for (; used_ < room_; ++used_) {
      put(R_, 1.0, 0.0, 0.0);
      put(R_, 0.0, 1.0, 0.0);
      put(R_, 0.0, 0.0, 1.0);
      put(t_, 0.0, 0.0, 0.0);
      put(n_, 0.0, 0.0, 0.0);
    }
    used_ = 0;
  }

 private:
  /// Takes a row.
  [[nodiscard]] bool has_room() {
    if (used_ == room_) return false;
    ++used_;
    return true;
  }
  /// yaw_rotation()
  void yaw(double c, double s) {
    put(R_, c, 0.0, -s);
    put(R_, 0.0, 1.0, 0.0);
    put(R_, s, 0.0, c);
  }
  static void put(double*& to, double x, double y, double z) {
    to[0] = x;
    to[1] = y;
    to[2] = z;
    to += 3;
  }

  double *R_, *t_, *n_;
  std::int64_t* count_;
  std::size_t room_, used_ = 0;
};

}  // namespace oneac::internal
