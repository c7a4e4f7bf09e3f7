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

/// Products of the columns multiplied out by hand: fewer operations than forming the six rows.
/// `c`, `s`, `q` are the columns, p = (m, 0, n_x, n_y, 0, 0) and −b = (0, y, 0, 0, 0, 1).
template <Axis kNormal>
inline void PlaneGram::add(const AffineCorrespondence& ac, double weight) {
  const double x = ac.x1.x(), y = ac.x1.y(), u = ac.x2.x(), v = ac.x2.y();
  const double a1 = ac.A(0, 0), a2 = ac.A(0, 1), a3 = ac.A(1, 0), a4 = ac.A(1, 1);
  const double squares = u * u + v * v;
  const double sigma = (a1 * a1 + a2 * a2) + (a3 * a3 + a4 * a4) + squares;
  const double tau = a1 + x * u;
  const double g1u = a1 * u + a3 * v + u;  // first column of A along x2, plus u
  const double g2 = a2 * u + a4 * v;
  const double c0 = x - u, s0 = -(x * u + 1.0);  // first entries of c and s
  const double c_c = sigma + 1.0 + x * x - 2.0 * tau;
  const double c_s = x * (sigma - tau - 1.0) + g1u - u;
  const double s_s = x * (x * sigma + 2.0 * g1u) + squares + 1.0;
  const double c_b = y * v + a4;
  double c_p = c0, s_p = s0, p_q = -u, p_p = 1.0, c_q = sigma - tau, s_q = x * sigma + g1u;
  double q_q = sigma, q_b = c_b;
  if constexpr (kNormal == Axis::kX) {  // q = s + (1, 0, 0, 0, 0, 0)
    c_p = x * c0 + 1.0 - a1;
    s_p = x * s0 - u - a1 * x;
    p_q = s_p + x;
    p_p = x * x + 1.0;
    c_q = c_s + c0;
    s_q = s_s + s0;
    q_q = s_s + 2.0 * s0 + 1.0;
    q_b = x * c_b;
  } else if constexpr (kNormal == Axis::kY) {
    c_p = y * c0 - a2;
    s_p = y * s0 - a2 * x;
    p_p = y * y + 1.0;
    p_q = -(u * p_p + a2 * y);
    c_q = y * c_q + g2;
    s_q = y * s_q + x * g2;
    q_q = y * (y * sigma + 2.0 * g2) + squares;
    q_b = v * p_p + a4 * y;
  }
  cc += weight * c_c;
  cs += weight * c_s;
  ss += weight * s_s;
  cp += weight * c_p;
  sp += weight * s_p;
  cq += weight * c_q;
  sq += weight * s_q;
  pp += weight * p_p;
  pq += weight * p_q;
  qq += weight * q_q;
  cb += weight * c_b;
  sb += weight * (x * c_b);
  qb += weight * q_b;
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
