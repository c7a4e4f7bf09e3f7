#pragma once

#include "oneac/geometry/affine_correspondence.h"

namespace oneac::internal {

/// The axis that is the normal of a plane.
enum class Axis { kX, kY, kZ };

/// n·x̃1: inverse depth of the point, times d.
template <Axis kNormal>
[[nodiscard]] double along_normal(const AffineCorrespondence& ac) {
  return kNormal == Axis::kX ? ac.x1.x() : kNormal == Axis::kY ? ac.x1.y() : 1.0;
}

[[nodiscard]] inline double dot6(const double (&a)[6], const double (&b)[6]) {
  return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]) + (a[4] * b[4] + a[5] * b[5]);
}

/// Normal equations of A x = b, eqs. (9) and (10), over any number of correspondences on a plane of
/// known normal: products of the columns of A = (c | s | p | q) and b. Unknowns (cos α, sin α,
/// p = t_x/d, q = t_z/d) with n·X = d, so that p and q carry the sign of d (the paper's walls have
/// the opposite sign). p·b is always zero.
struct PlaneGram {
  double cc = 0.0, cs = 0.0, ss = 0.0, cp = 0.0, sp = 0.0, cq = 0.0, sq = 0.0;
  double pp = 0.0, pq = 0.0, qq = 0.0, cb = 0.0, sb = 0.0, qb = 0.0, bb = 0.0;

  /// Adds the six rows of one correspondence, weighted.
  template <Axis kNormal>
  void add(const AffineCorrespondence& ac, double weight);
  /// Adds the two rows of its points, eq. (4), only.
  template <Axis kNormal>
  void add_points(const AffineCorrespondence& ac, double weight);
};

template <Axis kNormal>
inline void PlaneGram::add(const AffineCorrespondence& ac, double weight) {
  constexpr bool kAlongX = kNormal == Axis::kX, kAlongY = kNormal == Axis::kY;
  const double x = ac.x1.x(), y = ac.x1.y(), u = ac.x2.x(), v = ac.x2.y();
  const double a1 = ac.A(0, 0), a2 = ac.A(0, 1), a3 = ac.A(1, 0), a4 = ac.A(1, 1);
  const double m = along_normal<kNormal>(ac);
  // Columns of A; p has its only entries m, n_x, n_y in rows 0, 2, 3 and b its only ones −y, −1 in
  // 1, 5.
  const double c[6] = {x - u, -v, 1.0 - a1, -a2, -a3, -a4};
  const double s[6] = {-u * x - 1.0, -v * x, -u - a1 * x, -a2 * x, -v - a3 * x, -a4 * x};
  const double q[6] = {-u * m,
                       -v * m,
                       kAlongX ? -u - a1 * m : -a1 * m,
                       kAlongY ? -u - a2 * m : -a2 * m,
                       kAlongX ? -v - a3 * m : -a3 * m,
                       kAlongY ? -v - a4 * m : -a4 * m};
  const auto times_p = [m](const double(&column)[6]) {
    return m * column[0] + (kAlongX ? column[2] : kAlongY ? column[3] : 0.0);
  };
  cc += weight * dot6(c, c);
  cs += weight * dot6(c, s);
  ss += weight * dot6(s, s);
  cq += weight * dot6(c, q);
  sq += weight * dot6(s, q);
  qq += weight * dot6(q, q);
  cp += weight * times_p(c);
  sp += weight * times_p(s);
  pq += weight * times_p(q);
  pp += weight * (kNormal == Axis::kZ ? 1.0 : m * m + 1.0);
  cb -= weight * (y * c[1] + c[5]);
  sb -= weight * (y * s[1] + s[5]);
  qb -= weight * (y * q[1] + q[5]);
  bb += weight * (y * y + 1.0);
}

template <Axis kNormal>
inline void PlaneGram::add_points(const AffineCorrespondence& ac, double weight) {
  const double x = ac.x1.x(), y = ac.x1.y(), u = ac.x2.x(), v = ac.x2.y();
  const double m = along_normal<kNormal>(ac);
  const double c[2] = {x - u, -v}, s[2] = {-u * x - 1.0, -v * x}, q[2] = {-u * m, -v * m};
  cc += weight * (c[0] * c[0] + c[1] * c[1]);
  cs += weight * (c[0] * s[0] + c[1] * s[1]);
  ss += weight * (s[0] * s[0] + s[1] * s[1]);
  cq += weight * (c[0] * q[0] + c[1] * q[1]);
  sq += weight * (s[0] * q[0] + s[1] * q[1]);
  qq += weight * (q[0] * q[0] + q[1] * q[1]);
  cp += weight * m * c[0];
  sp += weight * m * s[0];
  pq += weight * m * q[0];
  pp += weight * m * m;
  cb -= weight * y * c[1];
  sb -= weight * y * s[1];
  qb -= weight * y * q[1];
  bb += weight * y * y;
}

}  // namespace oneac::internal
