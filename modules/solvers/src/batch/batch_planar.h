#pragma once

#include "batch/batch_lanes.h"

namespace oneac::internal {
namespace {

// Squared lengths outside are left to the scalar solver, whose hypot does not overflow.
constexpr double kTiny = 1e-200;
constexpr double kHuge = 1e200;
// Factor by which a squared share must be passed for the kernel to decide itself.
constexpr double kSurelySquared = 4.0;
// Depths below this share of the squared ray lengths are undecided.
constexpr double kSurelyDeep = 1e-10;

/// Entries (E12, E21, E23, E32), and whether they are clear of rounding.
struct EntryLanes {
  Lanes e12, e21, e23, e32;
  Mask sure;
};

/// Signed 3×3 minors of the 3×4 system of relpose_1ac_planar.cpp.
inline EntryLanes planar_entries(const AcLanes& ac) {
  const Lanes &x = ac.x, &y = ac.y, &u = ac.u, &v = ac.v;
  const Lanes m00 = u * y, m01 = v * x;
  const Lanes m10 = ac.a1 * y, m11 = ac.a3 * x + v;
  const Lanes m20 = ac.a2 * y + u, m21 = ac.a4 * x;
  const Lanes d01 = m10 * m21 - m11 * m20;
  const Lanes d02 = m10 * ac.a4 - ac.a3 * m20;
  const Lanes d12 = m11 * ac.a4 - ac.a3 * m21;
  EntryLanes e;
  e.e12 = m01 * ac.a3 - v * m11 + y * d12;
  e.e21 = -(m00 * ac.a3 - v * m10 + y * d02);
  e.e23 = m00 * m11 - m01 * m10 + y * d01;
  e.e32 = -(m00 * d12 - m01 * d02 + v * d01);
  const Lanes row0 = m00 * m00 + m01 * m01 + v * v + y * y;
  const Lanes row1 = m10 * m10 + m11 * m11 + ac.a3 * ac.a3;
  const Lanes row2 = m20 * m20 + m21 * m21 + ac.a4 * ac.a4 + 1.0;
  const Lanes squared = e.e12 * e.e12 + e.e21 * e.e21 + e.e23 * e.e23 + e.e32 * e.e32;
  e.sure = squared > kSurelySquared * kParallelRows * kParallelRows * (row0 * row1 * row2);
  return e;
}

/// pose_from_entries() of planar_entries.cpp; `solved` says whether the lane is sure so far.
inline PoseLanes planar_motion(const EntryLanes& e) {
  PoseLanes pose;
  const Lanes others = e.e21 * e.e21 + e.e23 * e.e23;
  const Lanes squared = e.e12 * e.e12 + e.e32 * e.e32;
  const Lanes inverse = 1.0 / square_root(squared);
  pose.tx = e.e32 * inverse;
  pose.tz = -e.e12 * inverse;
  const Lanes c = pose.tz * e.e21 - pose.tx * e.e23;
  const Lanes s = -pose.tx * e.e21 - pose.tz * e.e23;
  const Lanes norm = c * c + s * s;
  const Lanes inverse_norm = 1.0 / square_root(norm);
  pose.cos_alpha = c * inverse_norm;
  pose.sin_alpha = s * inverse_norm;
  pose.solved = e.sure & (squared > kSurelySquared * 1e-24 * others) & (squared > kTiny) &
                (squared < kHuge) & (norm > kSurelySquared * 1e-24 * squared) & (norm < kHuge);
  return pose;
}

/// relpose_1ac_planar for each lane.
inline PoseLanes planar_poses(const AcLanes& ac) {
  const Mask possible = ac.usable();
  PoseLanes pose = planar_motion(planar_entries(ac));
  const Lanes &c = pose.cos_alpha, &s = pose.sin_alpha;
  // cheirality() of geometry/triangulation.cpp: rays a = R x̃1 and b = x̃2.
  const Lanes a0 = c * ac.x - s, a1 = ac.y, a2 = s * ac.x + c;
  const Lanes aa = a0 * a0 + a1 * a1 + a2 * a2;
  const Lanes bb = ac.u * ac.u + ac.v * ac.v + 1.0;
  const Lanes ab = a0 * ac.u + a1 * ac.v + a2;
  const Lanes at = a0 * pose.tx + a2 * pose.tz;
  const Lanes bt = ac.u * pose.tx + pose.tz;
  const Lanes z1 = ab * bt - bb * at;
  const Lanes z2 = aa * bt - ab * at;
  const Lanes deep = kSurelyDeep * (aa * bb);
  const Mask sure = possible & pose.solved & (magnitude(z1) > deep) & (magnitude(z2) > deep);
  const Mask behind = z1 < 0.0;
  const Mask same_side = ~(behind ^ (z2 < 0.0));
  pose.tx = behind ? -pose.tx : pose.tx;
  pose.tz = behind ? -pose.tz : pose.tz;
  pose.solved = sure & same_side;
  pose.empty = ~possible | (sure & ~same_side);
  return pose;
}

}  // namespace
}  // namespace oneac::internal
