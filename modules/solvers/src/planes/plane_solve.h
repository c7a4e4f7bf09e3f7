#pragma once

#include "math/minimise_on_circle.h"
#include "math/thresholds.h"
#include "planes/plane_gram.h"
#include "planes/plane_null_vector.h"

#include <cmath>

namespace oneac::internal {

/// [A | −b]ᵀ[A | −b] − λI with p and q eliminated: a symmetric matrix over (c, s, 1), and what
/// gives p, q back. All of it times `det`, the determinant of the block of p and q, so that no
/// division delays it.
struct ReducedGram {
  double pp = 0.0, pq = 0.0, qq = 0.0, det = 0.0;
  double cc = 0.0, cs = 0.0, ss = 0.0, cb = 0.0, sb = 0.0, bb = 0.0;  // c·b, s·b for +b
  double p_of_c = 0.0, q_of_c = 0.0, p_of_s = 0.0, q_of_s = 0.0, p_of_b = 0.0, q_of_b = 0.0;

  [[nodiscard]] PlaneSolution solution(double c, double s, double inverse_det) const {
    return {c, s, (p_of_b - c * p_of_c - s * p_of_s) * inverse_det,
            (q_of_b - c * q_of_c - s * q_of_s) * inverse_det};
  }
};

/// False when the block of p and q is not positive definite.
[[nodiscard]] inline bool reduce(const PlaneGram& g, double shift, ReducedGram& r) {
  r.pp = g.pp - shift;
  r.pq = g.pq;
  r.qq = g.qq - shift;
  r.det = r.pp * r.qq - r.pq * r.pq;
  const double trace = g.pp + g.qq;
  if (!(r.pp > 0.0) || !(r.det > kSingularPlaneGram * trace * trace)) return false;
  r.p_of_c = r.qq * g.cp - r.pq * g.cq;
  r.q_of_c = r.pp * g.cq - r.pq * g.cp;
  r.p_of_s = r.qq * g.sp - r.pq * g.sq;
  r.q_of_s = r.pp * g.sq - r.pq * g.sp;
  r.p_of_b = -r.pq * g.qb;
  r.q_of_b = r.pp * g.qb;
  r.cc = r.det * (g.cc - shift) - g.cp * r.p_of_c - g.cq * r.q_of_c;
  r.cs = r.det * g.cs - g.cp * r.p_of_s - g.cq * r.q_of_s;
  r.ss = r.det * (g.ss - shift) - g.sp * r.p_of_s - g.sq * r.q_of_s;
  r.cb = r.det * g.cb - g.qb * r.q_of_c;
  r.sb = r.det * g.sb - g.qb * r.q_of_s;
  r.bb = r.det * (g.bb - shift) - g.qb * r.q_of_b;
  return true;
}

/// (AᵀA − λI)⁻¹ x by the same elimination: dx/dλ of the null vector x with a last entry of one.
[[nodiscard]] inline PlaneSolution solve_reduced(const ReducedGram& r, const PlaneSolution& x,
                                                 double inverse, double inverse_det) {
  const double c = r.det * x.c - r.p_of_c * x.p - r.q_of_c * x.q;
  const double s = r.det * x.s - r.p_of_s * x.p - r.q_of_s * x.q;
  const double yc = (r.ss * c - r.cs * s) * inverse;
  const double ys = (r.cc * s - r.cs * c) * inverse;
  const double p = r.qq * x.p - r.pq * x.q;
  const double q = r.pp * x.q - r.pq * x.p;
  return {yc, ys, (p - yc * r.p_of_c - ys * r.p_of_s) * inverse_det,
          (q - yc * r.q_of_c - ys * r.q_of_s) * inverse_det};
}

/// Homogeneous least squares: the eigenvector of the smallest eigenvalue of [A | −b]ᵀ[A | −b],
/// scaled to a last entry of one, then (c, s) normalised. False when the last entry vanishes or the
/// null space is not unique.
[[nodiscard]] inline bool search_null_vector(const PlaneGram& g, PlaneSolution& x) {
  // Newton on the last pivot of the elimination, a concave decreasing function of the shift whose
  // first root is the smallest eigenvalue, as long as all other pivots are positive. The vector
  // follows the last step with its first two derivatives, which needs no new elimination.
  double low = 0.0, shift = 0.0;
  for (int step = 0; step < kEigenvalueSteps; ++step) {
    ReducedGram r;
    const bool regular = reduce(g, shift, r);
    const double det = r.cc * r.ss - r.cs * r.cs;
    const double trace = r.cc + r.ss;
    if (!regular || !(r.cc > 0.0) || !(det > kSingularPlaneGram * trace * trace)) {
      if (!(shift > low)) return false;  // no unique null vector, or one without a last entry
      shift = 0.5 * (low + shift);
      continue;
    }
    const double inverse_both = 1.0 / (det * r.det);  // one division for two
    const double inverse = inverse_both * r.det;
    const double inverse_det = inverse_both * det;
    x = r.solution((r.ss * r.cb - r.cs * r.sb) * inverse, (r.cc * r.sb - r.cs * r.cb) * inverse,
                   inverse_det);
    const PlaneSolution y = solve_reduced(r, x, inverse, inverse_det);
    const double pivot = (r.bb - x.c * r.cb - x.s * r.sb) * inverse_det;
    const double squared = x.c * x.c + x.s * x.s + x.p * x.p + x.q * x.q + 1.0;
    const double bend = x.c * y.c + x.s * y.s + x.p * y.p + x.q * y.q;
    const double delta = pivot * squared / (squared * squared + pivot * bend);
    const double change =
        std::abs(delta) * (std::abs(y.c) + std::abs(y.s) + std::abs(y.p) + std::abs(y.q));
    if (change <= kEigenvectorStep) {
      PlaneSolution dx = y;
      if (change > kLinearStep) {
        const PlaneSolution z = solve_reduced(r, y, inverse, inverse_det);
        dx = {y.c + delta * z.c, y.s + delta * z.s, y.p + delta * z.p, y.q + delta * z.q};
      }
      x = {x.c + delta * dx.c, x.s + delta * dx.s, x.p + delta * dx.p, x.q + delta * dx.q};
      // Erratum: the last entry is one now, but c² + s² is not; only the rotation is normalised.
      const double length = std::sqrt(x.c * x.c + x.s * x.s);
      if (!(length > 1e-12)) return false;
      x.c /= length;
      x.s /= length;
      return true;
    }
    if (pivot > 0.0) low = shift;
    shift += delta;
  }
  return false;
}

/// The same, by the fast way where it leads there.
[[nodiscard]] inline bool solve_rapid(const PlaneGram& g, PlaneSolution& x) {
  return follow_null_vector(g, x) || search_null_vector(g, x);
}

/// min |A x − b|² subject to c² + s² = 1. False when p, q are not determined.
[[nodiscard]] inline bool solve_optimal(const PlaneGram& g, PlaneSolution& x) {
  ReducedGram r;
  if (!reduce(g, 0.0, r)) return false;
  const CircleProblem problem{r.cc, r.cs, r.ss, r.cb, r.sb};
  double c = 0.0, s = 0.0;
  if (!minimise_near_circle(problem, c, s)) minimise_far_from_circle(problem, c, s);
  x = r.solution(c, s, 1.0 / r.det);
  return true;
}

}  // namespace oneac::internal
