#pragma once

#include "consensus/consensus_kernels.h"

#include "oneac/base/simd_lanes.h"

namespace oneac::internal {
namespace {

// Keeps 0/0 out where both epipolar lines vanish; far below any gradient of a unit translation.
constexpr float kTinyGradient = 1e-30F;

inline FloatLanes at_most_one(const FloatLanes& ratio) {
  const FloatLanes one = FloatLanes{} + 1.0F;
  return ratio < one ? ratio : one;
}

/// Hypotheses in the lanes, points one after the other.
void planar_costs(const PlanarEssentials& hypotheses, const PointArrays<float>& points,
                  float inverse_squared_threshold, float* cost) {
  for (std::size_t h = 0; h < hypotheses.padded_size; h += kLanes<float>) {
    const FloatLanes e12 = load(hypotheses.e12 + h);
    const FloatLanes e21 = load(hypotheses.e21 + h);
    const FloatLanes e23 = load(hypotheses.e23 + h);
    const FloatLanes e32 = load(hypotheses.e32 + h);
    FloatLanes total = {};
    for (std::size_t i = 0; i < points.padded_size; ++i) {
      const float y1 = points.y1[i];
      const float y2 = points.y2[i];
      const FloatLanes f = e12 * points.x2[i] + e32;
      const FloatLanes b = e21 * points.x1[i] + e23;
      const FloatLanes a = e12 * y1;
      const FloatLanes d = e21 * y2;
      const FloatLanes algebraic = f * y1 + b * y2;
      const FloatLanes gradient = a * a + b * b + d * d + f * f + kTinyGradient;
      const FloatLanes ratio = algebraic * algebraic * inverse_squared_threshold / gradient;
      total += at_most_one(ratio) * points.weight[i];
    }
    store(total, cost + h);
  }
}

/// Points in the lanes. Partial sums [part, part + kLanes) of the groups [first, last).
inline FloatLanes msac_part(const float* E, const PointArrays<float>& points, std::size_t first,
                            std::size_t last, float inverse_squared_threshold, std::size_t part) {
  FloatLanes total = {};
  for (std::size_t i = first * kPointGroup + part; i < last * kPointGroup; i += kPointGroup) {
    const FloatLanes x1 = load(points.x1 + i);
    const FloatLanes y1 = load(points.y1 + i);
    const FloatLanes x2 = load(points.x2 + i);
    const FloatLanes y2 = load(points.y2 + i);
    const FloatLanes weight = load(points.weight + i);
    const FloatLanes a = E[0] * x1 + E[1] * y1 + E[2];
    const FloatLanes b = E[3] * x1 + E[4] * y1 + E[5];
    const FloatLanes c = E[6] * x1 + E[7] * y1 + E[8];
    const FloatLanes d = E[0] * x2 + E[3] * y2 + E[6];
    const FloatLanes f = E[1] * x2 + E[4] * y2 + E[7];
    const FloatLanes algebraic = x2 * a + y2 * b + c;
    const FloatLanes gradient = a * a + b * b + d * d + f * f + kTinyGradient;
    total += at_most_one(algebraic * algebraic * inverse_squared_threshold / gradient) * weight;
  }
  return total;
}

float msac(const float* E, const PointArrays<float>& points, std::size_t first, std::size_t last,
           float inverse_squared_threshold) {
  static_assert(kPartialSums<float> == kPointGroup);
  float partial[kPartialSums<float>];
  for (std::size_t part = 0; part < kPartialSums<float>; part += kLanes<float>) {
    store(msac_part(E, points, first, last, inverse_squared_threshold, part), partial + part);
  }
  return total(partial);
}

/// Three coordinates per lane.
template <class Lanes>
struct Vector {
  Lanes x, y, z;
};

template <class A, class B>
inline auto cross(const A& a, const B& b) {
  using Lanes = decltype(a.x * b.x);
  return Vector<Lanes>{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// v −= share (a + b).
template <class Lanes>
inline void take_away(const Lanes& share, const Vector<Lanes>& a, const Vector<Lanes>& b,
                      Vector<Lanes>& v) {
  v.x -= share * (a.x + b.x);
  v.y -= share * (a.y + b.y);
  v.z -= share * (a.z + b.z);
}

/// NormalSums, each in its partial sums.
template <class Number>
struct PartialNormalSums {
  Number cost[kPartialSums<Number>];
  Number g[5][kPartialSums<Number>];
  Number H[15][kPartialSums<Number>];
};

/// Points in the lanes. With y = R x1 and q = x2 × t the algebraic distance x2ᵀ[t]×R x1 is q·y, its
/// derivative y × q with respect to w and (y × x2)·T with respect to b. The squared gradient norm
/// is |l|² + |k|² with the lines l = (t × y)₁₂ and k = (Rᵀ q)₁₂.
template <class Number, bool kExact, bool kNewton>
void normal_part(const PoseNumbers<Number>& pose, const PointArrays<Number>& points,
                 Number squared_scale, std::size_t part, PartialNormalSums<Number>& out) {
  using Lanes = typename LanesOf<Number>::Type;
  Lanes cost = {};
  Lanes g[5] = {};
  Lanes H[15] = {};
  const Number* R = pose.R;
  const Vector<Number> t{pose.t[0], pose.t[1], pose.t[2]};
  for (std::size_t i = part; i < points.padded_size; i += kPartialSums<Number>) {
    const Lanes x1 = load(points.x1 + i);
    const Lanes y1 = load(points.y1 + i);
    const Lanes weight = load(points.weight + i);
    const Vector<Lanes> x2{load(points.x2 + i), load(points.y2 + i), weight * 0 + 1};
    const Vector<Lanes> y{R[0] * x1 + R[1] * y1 + R[2], R[3] * x1 + R[4] * y1 + R[5],
                          R[6] * x1 + R[7] * y1 + R[8]};
    const Vector<Lanes> q = cross(x2, t);
    const Lanes algebraic = q.x * y.x + q.y * y.y + q.z * y.z;
    const Lanes lx = t.y * y.z - t.z * y.y;
    const Lanes ly = t.z * y.x - t.x * y.z;
    const Lanes kx = R[0] * q.x + R[3] * q.y + R[6] * q.z;
    const Lanes ky = R[1] * q.x + R[4] * q.y + R[7] * q.z;
    const Lanes gradient =
        lx * lx + ly * ly + kx * kx + ky * ky + static_cast<Number>(kTinyGradient);
    const Lanes inverse = 1 / (algebraic * algebraic + squared_scale * gradient);
    const Lanes rho = algebraic * algebraic * inverse;
    cost += rho * weight;
    // ρ'(r)/(2 r) over the squared gradient norm.
    const Lanes w = squared_scale * gradient * inverse * inverse * weight;
    Vector<Lanes> by_w = cross(y, q);
    Vector<Lanes> by_t = cross(y, x2);
    if (kExact) {
      const Lanes share = algebraic / gradient;
      const Vector<Lanes> Rk{R[0] * kx + R[1] * ky, R[3] * kx + R[4] * ky, R[6] * kx + R[7] * ky};
      const Vector<Lanes> lt{ly * t.z, -lx * t.z, lx * t.y - ly * t.x};  // l × t
      const Vector<Lanes> yl{-y.z * ly, y.z * lx, y.x * ly - y.y * lx};  // y × l
      const Vector<Lanes> first = cross(y, lt);
      const Vector<Lanes> second = cross(Rk, q);
      const Vector<Lanes> third = cross(Rk, x2);
      take_away(share, first, second, by_w);
      take_away(share, yl, third, by_t);
    }
    const Lanes J[5] = {by_w.x, by_w.y, by_w.z,
                        by_t.x * pose.T1[0] + by_t.y * pose.T1[1] + by_t.z * pose.T1[2],
                        by_t.x * pose.T2[0] + by_t.y * pose.T2[1] + by_t.z * pose.T2[2]};
    const Lanes wr = w * algebraic;
    const Lanes curved = 1 - 4 * rho;
    const Lanes h = !kNewton ? w : w * curved;
    for (int k = 0, n = 0; k < 5; ++k) {
      g[k] += wr * J[k];
      const Lanes wJ = h * J[k];
      for (int m = k; m < 5; ++m) H[n++] += wJ * J[m];
    }
  }
  store(cost, out.cost + part);
  for (int k = 0; k < 5; ++k) store(g[k], out.g[k] + part);
  for (int k = 0; k < 15; ++k) store(H[k], out.H[k] + part);
}

template <class Number, bool kExact, bool kNewton>
void normal_sums(const PoseNumbers<Number>& pose, const PointArrays<Number>& points,
                 Number squared_scale, NormalSums<Number>& out) {
  PartialNormalSums<Number> partial;
  for (std::size_t part = 0; part < kPartialSums<Number>; part += kLanes<Number>) {
    normal_part<Number, kExact, kNewton>(pose, points, squared_scale, part, partial);
  }
  out.cost = total(partial.cost);
  for (int k = 0; k < 5; ++k) out.g[k] = total(partial.g[k]);
  for (int k = 0; k < 15; ++k) out.H[k] = total(partial.H[k]);
}

constexpr ConsensusKernels kConsensusKernels{
    &planar_costs, &msac, &normal_sums<float, false, false>, &normal_sums<double, true, false>,
    &normal_sums<double, true, true>};

}  // namespace

template <>
const ConsensusKernels& simd_kernels_at<ConsensusKernels, kSimdLevel>() {
  return kConsensusKernels;
}

}  // namespace oneac::internal
