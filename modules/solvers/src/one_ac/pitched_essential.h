#pragma once

#include "math/epipolar_rows.h"

#include "oneac/solvers/relpose_1ac_planar_pitch.h"

#include <Eigen/Core>

#include <cmath>

namespace oneac::internal {

/// Yaw, heading of t (t_x = sin, t_z = cos) and pitch.
struct Angles {
  double alpha, heading, pitch;

  [[nodiscard]] PitchedPose pose() const {
    return {{std::cos(alpha), std::sin(alpha), std::sin(heading), std::cos(heading)}, pitch};
  }
};

/// E row by row and its derivatives by the three angles. With S = heading + yaw the entries of the
/// planar E are E12 = −cos heading, E21 = cos S, E23 = −sin S, E32 = sin heading; the pitch mixes
/// rows two and three.
struct Essential {
  Vector9 e;
  Eigen::Matrix<double, 9, 3> J;

  Angles angles;

  explicit Essential(const Angles& a) : angles(a) {
    const double ch = std::cos(a.heading), sh = std::sin(a.heading);
    const double cs = std::cos(a.heading + a.alpha), ss = std::sin(a.heading + a.alpha);
    const double cp = std::cos(a.pitch), sp = std::sin(a.pitch);
    e << 0.0, -ch, 0.0, cp * cs, sp * sh, -cp * ss, -sp * cs, cp * sh, sp * ss;
    J.col(0) << 0.0, 0.0, 0.0, -cp * ss, 0.0, -cp * cs, sp * ss, 0.0, sp * cs;
    J.col(1) << 0.0, sh, 0.0, -cp * ss, sp * ch, -cp * cs, sp * ss, cp * ch, sp * cs;
    J.col(2) << 0.0, 0.0, 0.0, -sp * cs, cp * sh, sp * ss, -cp * cs, -sp * sh, cp * ss;
  }

  [[nodiscard]] Essential moved(const Eigen::Vector3d& by) const {
    return Essential({angles.alpha + by.x(), angles.heading + by.y(), angles.pitch + by.z()});
  }
};

}  // namespace oneac::internal
