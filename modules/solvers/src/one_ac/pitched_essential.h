#pragma once

#include "oneac/geometry/affine_correspondence.h"
#include "oneac/solvers/relpose_1ac_planar_pitch.h"

#include <Eigen/Core>

#include <cmath>

namespace oneac::internal {

using Vector9 = Eigen::Matrix<double, 9, 1>;

/// The three equations of one correspondence on a whole E, row by row.
[[nodiscard]] inline Eigen::Matrix<double, 3, 9> epipolar_rows(const AffineCorrespondence& ac) {
  const double x = ac.x1.x(), y = ac.x1.y(), u = ac.x2.x(), v = ac.x2.y();
  const double a1 = ac.A(0, 0), a2 = ac.A(0, 1), a3 = ac.A(1, 0), a4 = ac.A(1, 1);
  Eigen::Matrix<double, 3, 9> m;
  m << u * x, u * y, u, v * x, v * y, v, x, y, 1.0,                   //
      a1 * x + u, a1 * y, a1, a3 * x + v, a3 * y, a3, 1.0, 0.0, 0.0,  //
      a2 * x, a2 * y + u, a2, a4 * x, a4 * y + v, a4, 0.0, 1.0, 0.0;
  return m;
}

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

  explicit Essential(const Angles& a) {
    const double ch = std::cos(a.heading), sh = std::sin(a.heading);
    const double cs = std::cos(a.heading + a.alpha), ss = std::sin(a.heading + a.alpha);
    const double cp = std::cos(a.pitch), sp = std::sin(a.pitch);
    e << 0.0, -ch, 0.0, cp * cs, sp * sh, -cp * ss, -sp * cs, cp * sh, sp * ss;
    J.col(0) << 0.0, 0.0, 0.0, -cp * ss, 0.0, -cp * cs, sp * ss, 0.0, sp * cs;
    J.col(1) << 0.0, sh, 0.0, -cp * ss, sp * ch, -cp * cs, sp * ss, cp * ch, sp * cs;
    J.col(2) << 0.0, 0.0, 0.0, -sp * cs, cp * sh, sp * ss, -cp * cs, -sp * sh, cp * ss;
  }
};

}  // namespace oneac::internal
