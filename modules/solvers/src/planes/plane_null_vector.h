#pragma once

#include "math/thresholds.h"
#include "planes/plane_gram.h"

#include <cmath>

namespace oneac::internal {

/// Solution (cos α, sin α, p, q) with a unit (cos α, sin α).
struct PlaneSolution {
  double c, s, p, q;
};

/// Entries of c, s and q.
struct PlaneVector {
  double c, s, q;
};

[[nodiscard]] inline double dot(const PlaneVector& a, const PlaneVector& b) {
  return a.c * b.c + (a.s * b.s + a.q * b.q);
}

/// [A | −b]ᵀ[A | −b] − λI with the columns of p and −b, which are orthogonal, eliminated: a
/// symmetric S over (c, s, q), kept as its adjugate.
struct ShiftedGram {
  PlaneVector p, b;               ///< products of the columns with p and −b, by their pivots
  double cc, cs, cq, ss, sq, qq;  ///< adjugate of S
  double det, trace, trace_of_adjugate;

  /// det · S⁻¹ v.
  [[nodiscard]] PlaneVector solve(const PlaneVector& v) const {
    return {cc * v.c + (cs * v.s + cq * v.q), cs * v.c + (ss * v.s + sq * v.q),
            cq * v.c + (sq * v.s + qq * v.q)};
  }
  /// −dS/dλ v.
  [[nodiscard]] PlaneVector slope(const PlaneVector& v) const {
    const double along_p = dot(p, v), along_b = dot(b, v);
    return {v.c + (p.c * along_p + b.c * along_b), v.s + (p.s * along_p + b.s * along_b),
            v.q + (p.q * along_p + b.q * along_b)};
  }
};

/// False when λ is not left of the pivots of p and −b.
[[nodiscard]] inline bool shift_gram(const PlaneGram& g, double shift, ShiftedGram& r) {
  const double pp = g.pp - shift, bb = g.bb - shift;
  if (!(pp > 0.0) || !(bb > 0.0)) return false;
  const double inverse_p = 1.0 / pp, inverse_b = -1.0 / bb;
  r.p = {g.cp * inverse_p, g.sp * inverse_p, g.pq * inverse_p};
  r.b = {g.cb * inverse_b, g.sb * inverse_b, g.qb * inverse_b};
  const double cc = (g.cc - shift) - g.cp * r.p.c + g.cb * r.b.c;
  const double cs = g.cs - g.cp * r.p.s + g.cb * r.b.s;
  const double cq = g.cq - g.cp * r.p.q + g.cb * r.b.q;
  const double ss = (g.ss - shift) - g.sp * r.p.s + g.sb * r.b.s;
  const double sq = g.sq - g.sp * r.p.q + g.sb * r.b.q;
  const double qq = (g.qq - shift) - g.pq * r.p.q + g.qb * r.b.q;
  r.cc = ss * qq - sq * sq;
  r.cs = sq * cq - cs * qq;
  r.cq = cs * sq - ss * cq;
  r.ss = cc * qq - cq * cq;
  r.sq = cs * cq - cc * sq;
  r.qq = cc * ss - cs * cs;
  r.det = cc * r.cc + (cs * r.cs + cq * r.cq);
  r.trace = cc + ss + qq;
  r.trace_of_adjugate = r.cc + r.ss + r.qq;
  return true;
}

/// The products with p and −b by their pivots at λ + delta, for the entries of p and −b.
inline void move_pivots(const PlaneGram& g, double shift, double delta, ShiftedGram& r) {
  const double of_p = 1.0 + delta / (g.pp - shift - delta);
  const double of_b = 1.0 + delta / (g.bb - shift - delta);
  r.p = {r.p.c * of_p, r.p.s * of_p, r.p.q * of_p};
  r.b = {r.b.c * of_b, r.b.s * of_b, r.b.q * of_b};
}

/// Column of the adjugate, which is λ2 λ3 v vᵀ at the null vector v: that of c where it is not
/// tiny.
[[nodiscard]] inline PlaneVector first_null_vector(const ShiftedGram& r) {
  if (r.cc > kTinyColumn * r.trace_of_adjugate) return {r.cc, r.cs, r.cq};
  return r.ss > r.qq ? PlaneVector{r.cs, r.ss, r.sq} : PlaneVector{r.cq, r.sq, r.qq};
}

/// Scaled to a last entry of one, then (c, s) normalised. Erratum: the last entry is one, but
/// c² + s² is not; only the rotation is normalised. False when the last entry or (c, s) vanishes.
[[nodiscard]] inline bool scale_null_vector(const ShiftedGram& r, const PlaneVector& v,
                                            PlaneSolution& x) {
  const double last = -dot(r.b, v);
  const double length = std::sqrt(v.c * v.c + v.s * v.s);
  if (!(std::abs(last) > kNoLastEntry * (length + std::abs(v.q)))) return false;
  if (!(length > kNoRotation * std::abs(last))) return false;
  const double inverse = 1.0 / last;
  const double inverse_length = 1.0 / std::copysign(length, last);
  x = {v.c * inverse_length, v.s * inverse_length, -dot(r.p, v) * inverse, v.q * inverse};
  return true;
}

/// Eigenvector of the smallest eigenvalue of [A | −b]ᵀ[A | −b] by inverse iteration with Rayleigh
/// quotients from λ = 0, where it is without noise. False when it did not find that one: nothing is
/// said about the input then.
[[nodiscard]] inline bool follow_null_vector(const PlaneGram& g, PlaneSolution& x) {
  double shift = 0.0;
  for (int step = 0; step < kRayleighSteps; ++step) {
    ShiftedGram r;
    if (!shift_gram(g, shift, r)) return false;
    // All of S but the eigenvalue next to λ is positive, and so are the pivots: it is the smallest.
    const double square = r.trace_of_adjugate * r.trace_of_adjugate;
    if (!(r.trace > 0.0) || !(r.trace_of_adjugate > kSingularPlaneGram * r.trace * r.trace)) {
      return false;
    }
    // (λ1 − λ)/λ2 of S times `square`, in the metric of −dS/dλ, whose eigenvalues lie between one
    // and `stretch`.
    const double stretch = 1.0 + dot(r.p, r.p) + dot(r.b, r.b);
    const double nearness = std::abs(r.det) * r.trace * stretch;
    const PlaneVector slope = r.slope(first_null_vector(r));
    const PlaneVector v = r.solve(slope);
    const PlaneVector next = r.slope(v);
    const double delta = r.det * dot(v, slope) / dot(v, next);
    if (nearness <= kNear * square) {
      move_pivots(g, shift, delta, r);
      return scale_null_vector(r, nearness <= kVeryNear * square ? v : r.solve(next), x);
    }
    shift += delta;
  }
  return false;
}

}  // namespace oneac::internal
