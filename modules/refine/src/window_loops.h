#pragma once

#include "window_kernels.h"

#include "oneac/base/simd_lanes.h"

// The kernels of window_kernels.h for one width. Lanes run along the six numbers of a pose.
namespace oneac::internal {
namespace {

using Doubles = DoubleLanes;
constexpr std::size_t kWidth = kLanes<double>;

constexpr std::size_t kRegisters = kPaddedPose / kWidth;

/// A block of the poses' equations while it is summed.
struct BlockRegisters {
  Doubles column[kPoseNumbers][kRegisters];

  explicit BlockRegisters(const PoseBlockSum& H) {
    for (std::size_t c = 0; c < kPoseNumbers; ++c) {
      for (std::size_t k = 0; k < kRegisters; ++k) column[c][k] = load(H.column[c] + k * kWidth);
    }
  }
  void store_to(PoseBlockSum& H) const {
    for (std::size_t c = 0; c < kPoseNumbers; ++c) {
      for (std::size_t k = 0; k < kRegisters; ++k) store(column[c][k], H.column[c] + k * kWidth);
    }
  }
};

inline void add_coupling(const PointRow& point, const PoseDerivative& J, CouplingSum& W) {
  for (std::size_t i = 0; i < kPaddedPose; i += kWidth) {
    const Doubles j0 = load(J.row[0] + i), j1 = load(J.row[1] + i);
    for (std::size_t k = 0; k < 3; ++k) {
      double* out = W.row[k] + i;
      store(load(out) + (j0 * point.J[0][k] + j1 * point.J[1][k]), out);
    }
  }
}

inline void add_gradient(const PoseDerivative& J, const double* r, PoseSum& g) {
  for (std::size_t i = 0; i < kPaddedPose; i += kWidth) {
    const Doubles j0 = load(J.row[0] + i), j1 = load(J.row[1] + i);
    store(load(g.entry + i) + (j0 * r[0] + j1 * r[1]), g.entry + i);
  }
}

inline void add_pairs(const DerivativePair* first, const DerivativePair* last, PoseBlockSum& H,
                      PoseSum* g) {
  BlockRegisters sum(H);
  for (const DerivativePair* pair = first; pair != last; ++pair) {
    const PoseDerivative &A = *pair->lower, &B = *pair->upper;
    for (std::size_t k = 0; k < kRegisters; ++k) {
      const Doubles a0 = load(A.row[0] + k * kWidth), a1 = load(A.row[1] + k * kWidth);
      for (std::size_t c = 0; c < kPoseNumbers; ++c) {
        sum.column[c][k] = sum.column[c][k] + (a0 * B.row[0][c] + a1 * B.row[1][c]);
      }
    }
    if (g != nullptr) add_gradient(B, pair->r, *g);
  }
  sum.store_to(H);
}

inline void reduce(const ReducedLandmark& landmark, WindowLink* first, WindowLink* last) {
  const double(&L)[3][3] = landmark.inverse_root;
  for (WindowLink* link = first; link != last; ++link) {
    for (std::size_t i = 0; i < kPaddedPose; i += kWidth) {
      const Doubles w0 = load(link->W.row[0] + i), w1 = load(link->W.row[1] + i),
                    w2 = load(link->W.row[2] + i);
      store(w0 * L[0][0], link->reduced.row[0] + i);
      store(w0 * L[1][0] + w1 * L[1][1], link->reduced.row[1] + i);
      store(w0 * L[2][0] + w1 * L[2][1] + w2 * L[2][2], link->reduced.row[2] + i);
    }
  }
}

inline void add_right_side(const CouplingSum& reduced, const double* g, PoseSum& rhs) {
  for (std::size_t i = 0; i < kPaddedPose; i += kWidth) {
    const Doubles r0 = load(reduced.row[0] + i), r1 = load(reduced.row[1] + i),
                  r2 = load(reduced.row[2] + i);
    store(load(rhs.entry + i) + (r0 * g[0] + r1 * g[1] + r2 * g[2]), rhs.entry + i);
  }
}

inline void take_pairs(const CouplingPair* first, const CouplingPair* last, PoseBlockSum& S,
                       PoseSum* rhs) {
  BlockRegisters sum(S);
  for (const CouplingPair* pair = first; pair != last; ++pair) {
    const CouplingSum &A = *pair->lower, &B = *pair->upper;
    for (std::size_t k = 0; k < kRegisters; ++k) {
      const Doubles a0 = load(A.row[0] + k * kWidth), a1 = load(A.row[1] + k * kWidth),
                    a2 = load(A.row[2] + k * kWidth);
      for (std::size_t c = 0; c < kPoseNumbers; ++c) {
        sum.column[c][k] =
            sum.column[c][k] - (a0 * B.row[0][c] + a1 * B.row[1][c] + a2 * B.row[2][c]);
      }
    }
    if (rhs != nullptr) add_right_side(B, pair->g, *rhs);
  }
  sum.store_to(S);
}

constexpr WindowKernels kWindowKernels{&add_coupling, &add_pairs, &reduce, &take_pairs};

}  // namespace

template <>
const WindowKernels& simd_kernels_at<WindowKernels, kSimdLevel>() {
  return kWindowKernels;
}

}  // namespace oneac::internal
