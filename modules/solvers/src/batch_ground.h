#pragma once

#include "batch_lanes.h"

namespace oneac::internal {
namespace {

// Share by which a threshold must be passed for the kernel to decide itself.
constexpr double kSurely = 2.0;
// Depths of the plane in the second view [distances to it] this near zero are undecided.
constexpr double kSurelyBehind = 1e-6;

struct Column {
  Lanes row[6];
};

inline Lanes dot6(const Column& a, const Column& b) {
  return a.row[0] * b.row[0] + a.row[1] * b.row[1] + a.row[2] * b.row[2] + a.row[3] * b.row[3] +
         a.row[4] * b.row[4] + a.row[5] * b.row[5];
}

/// The problem on the circle, zᵀ Q z − 2 hᵀ z, and what gives p, q back from z; times `det`.
struct CircleProblem {
  Lanes det, cc, cs, ss, cb, sb;
  Lanes p_of_c, q_of_c, p_of_s, q_of_s, p_of_b, q_of_b;
  Mask regular;
};

/// PlaneGram::add and reduce() of planar_plane_system.cpp for n = (0, 1, 0), operation by
/// operation.
inline CircleProblem ground_problem(const AcLanes& ac) {
  const Lanes &x = ac.x, &y = ac.y, &u = ac.u, &v = ac.v;
  const Column c{{x - u, -v, 1.0 - ac.a1, -ac.a2, -ac.a3, -ac.a4}};
  const Column s{{-u * x - 1.0, -v * x, -u - ac.a1 * x, -ac.a2 * x, -v - ac.a3 * x, -ac.a4 * x}};
  const Column q{{-u * y, -v * y, -ac.a1 * y, -u - ac.a2 * y, -ac.a3 * y, -v - ac.a4 * y}};
  const Lanes cc = dot6(c, c), cs = dot6(c, s), ss = dot6(s, s);
  const Lanes cq = dot6(c, q), sq = dot6(s, q), qq = dot6(q, q);
  const Lanes cp = y * c.row[0] + c.row[3], sp = y * s.row[0] + s.row[3];
  const Lanes pq = y * q.row[0] + q.row[3], pp = y * y + 1.0;
  const Lanes cb = -(y * c.row[1] + c.row[5]), sb = -(y * s.row[1] + s.row[5]);
  const Lanes qb = -(y * q.row[1] + q.row[5]);
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
  Lanes lambda = all(0.0);
  Mask valid = r.regular;
  Mask open = valid;
  for (int step = 0; step <= kHalleySteps; ++step) {
    const Lanes q00 = r.cc + lambda, q11 = r.ss + lambda;
    const Lanes det = q00 * q11 - r.cs * r.cs;
    const Lanes trace = q00 + q11;
    const Lanes n0 = q11 * r.cb - r.cs * r.sb;
    const Lanes n1 = q00 * r.sb - r.cs * r.cb;
    const Lanes squared = n0 * n0 + n1 * n1;
    const Lanes length = square_root(squared);
    valid &= (trace > 0.0) & (det > kNearHardCase * trace * trace) & (length > 0.0);
    open &= valid;
    if (!any(open)) {
      const Lanes inverse = 1.0 / length;
      c = n0 * inverse;
      s = n1 * inverse;
      return valid;
    }
    const Lanes m0 = q11 * n0 - r.cs * n1;
    const Lanes m1 = q00 * n1 - r.cs * n0;
    const Lanes slope = n0 * m0 + n1 * m1;
    const Lanes cross = n0 * m1 - n1 * m0;
    const Lanes excess = length - det;
    const Lanes delta =
        excess * squared * det * slope / (det * slope * slope - 1.5 * excess * cross * cross);
    lambda = open ? lambda + delta : lambda;
    open &= ~(magnitude(delta) * trace <= kHalleyStep * det);
  }
  return valid & ~valid;
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
