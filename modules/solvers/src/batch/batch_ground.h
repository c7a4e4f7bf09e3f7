#pragma once

#include "batch/batch_lanes.h"

namespace oneac::internal {
namespace {

// Share by which a threshold must be passed for the kernel to decide itself.
constexpr double kSurely = 2.0;
// Depths of the plane in the second view [distances to it] this near zero are undecided.
constexpr double kSurelyBehind = 1e-6;

/// The problem on the circle, zᵀ Q z − 2 hᵀ z, and what gives p, q back from z; times `det`.
struct CircleProblem {
  Lanes det, cc, cs, ss, cb, sb;
  Lanes p_of_c, q_of_c, p_of_s, q_of_s, p_of_b, q_of_b;
  Mask regular;
};

/// PlaneGram::add and reduce() of plane_gram.h and plane_solve.h for n = (0, 1, 0), operation by
/// operation.
inline CircleProblem ground_problem(const AcLanes& ac) {
  const Lanes &x = ac.x, &y = ac.y, &u = ac.u, &v = ac.v;
  const Lanes &a1 = ac.a1, &a2 = ac.a2, &a3 = ac.a3, &a4 = ac.a4;
  const Lanes squares = u * u + v * v;
  const Lanes sigma = (a1 * a1 + a2 * a2) + (a3 * a3 + a4 * a4) + squares;
  const Lanes tau = a1 + x * u;
  const Lanes g1u = a1 * u + a3 * v + u, g2 = a2 * u + a4 * v;
  const Lanes cc = sigma + 1.0 + x * x - 2.0 * tau;
  const Lanes cs = x * (sigma - tau - 1.0) + g1u - u;
  const Lanes ss = x * (x * sigma + 2.0 * g1u) + squares + 1.0;
  const Lanes pp = y * y + 1.0, pq = -(u * pp + a2 * y);
  const Lanes cp = y * (x - u) - a2, sp = -y * (x * u + 1.0) - a2 * x;
  const Lanes cq = y * (sigma - tau) + g2, sq = y * (x * sigma + g1u) + x * g2;
  const Lanes qq = y * (y * sigma + 2.0 * g2) + squares;
  const Lanes cb = y * v + a4, sb = x * cb, qb = v * pp + a4 * y;
  CircleProblem r;
  r.det = pp * qq - pq * pq;
  const Lanes trace = pp + qq;
  r.regular = r.det > kSurely * kSingularPlaneGram * trace * trace;
  r.p_of_c = qq * cp - pq * cq;
  r.q_of_c = pp * cq - pq * cp;
  r.p_of_s = qq * sp - pq * sq;
  r.q_of_s = pp * sq - pq * sp;
  r.p_of_b = -pq * qb;
  r.q_of_b = pp * qb;
  r.cc = r.det * cc - cp * r.p_of_c - cq * r.q_of_c;
  r.cs = r.det * cs - cp * r.p_of_s - cq * r.q_of_s;
  r.ss = r.det * ss - sp * r.p_of_s - sq * r.q_of_s;
  r.cb = r.det * cb - qb * r.q_of_c;
  r.sb = r.det * sb - qb * r.q_of_s;
  return r;
}

/// minimise_near_circle() of minimise_on_circle.cpp; the lanes where it gives up come back as zero.
/// A lane that has converged stands still while its neighbours go on, so that no result depends on
/// them.
inline Mask minimise_near_circle(const CircleProblem& r, Lanes& c, Lanes& s) {
  const Lanes T = r.cc + r.ss, D = r.cc * r.ss - r.cs * r.cs;
  const Lanes n0 = r.ss * r.cb - r.cs * r.sb, n1 = r.cc * r.sb - r.cs * r.cb;
  const Lanes c0 = D * D - (n0 * n0 + n1 * n1);
  const Lanes c1 = 2.0 * (T * D - (n0 * r.cb + n1 * r.sb));
  const Lanes c2 = T * T + 2.0 * D - (r.cb * r.cb + r.sb * r.sb);
  Lanes lambda = all(0.0);
  Lanes value = c0, slope = c1, bend = c2;
  Mask valid = r.regular;
  Mask open = valid;
  for (int step = 0; step < kHalleySteps; ++step) {
    const Lanes delta = value * slope / (value * bend - slope * slope);
    lambda = open ? lambda + delta : lambda;
    const Lanes det = D + lambda * (T + lambda);
    const Lanes trace = T + 2.0 * lambda;
    valid &= (trace > 0.0) & (det > kNearHardCase * trace * trace);
    open &= valid & ~(magnitude(delta) * trace <= kHalleyStep * det);
    if (!any(open)) break;
    const Lanes squared = lambda * lambda;
    value = c0 + lambda * c1 + squared * (c2 + lambda * (2.0 * T + lambda));
    slope = c1 + 2.0 * lambda * c2 + squared * (6.0 * T + 4.0 * lambda);
    bend = c2 + 6.0 * (lambda * T + squared);
  }
  const Lanes x = n0 + lambda * r.cb, y = n1 + lambda * r.sb;
  const Lanes length = square_root(x * x + y * y);
  c = x / length;
  s = y / length;
  return valid & ~open & (length > 0.0);
}

/// relpose_1ac_ground for each lane.
inline PoseLanes ground_poses(const AcLanes& ac) {
  const Mask possible = ac.usable() & (ac.y > kGroundHorizon);
  const CircleProblem r = ground_problem(ac);
  PoseLanes pose;
  Lanes& c = pose.cos_alpha;
  Lanes& s = pose.sin_alpha;
  c = s = all(0.0);
  const Mask converged = minimise_near_circle(r, c, s);
  const Lanes inverse_det = 1.0 / r.det;
  pose.tx = (r.p_of_b - c * r.p_of_c - s * r.p_of_s) * inverse_det;
  pose.tz = (r.q_of_b - c * r.q_of_c - s * r.q_of_s) * inverse_det;
  const Lanes squared = pose.tx * pose.tx + pose.tz * pose.tz;
  const Mask moved = (squared > kSurely * kNoPlaneMotion * kNoPlaneMotion) & (squared < 1e300);
  const Lanes z2 = s * ac.x + pose.tz * ac.y + c;  // the plane must stay before the second camera
  pose.solved = possible & converged & moved & (z2 > kSurelyBehind);
  pose.empty = ~possible | (converged & moved & (z2 < -kSurelyBehind));
  return pose;
}

}  // namespace
}  // namespace oneac::internal
