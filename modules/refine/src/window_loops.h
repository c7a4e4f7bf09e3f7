#pragma once

#include "window_kernels.h"

#include "oneac/base/simd_lanes.h"

// The kernels of window_kernels.h for one width. Lanes run along the six numbers of a pose.
namespace oneac::internal {
namespace {

using Doubles = DoubleLanes;
constexpr std::size_t kWidth = kLanes<double>;

/// H += Aᵀ B, a column at a time.
inline void add_pair(const PoseDerivative& A, const PoseDerivative& B, PoseBlockSum& H) {
  for (std::size_t i = 0; i < kPaddedPose; i += kWidth) {
    const Doubles a0 = load(A.row[0] + i), a1 = load(A.row[1] + i);
    for (std::size_t c = 0; c < kPoseNumbers; ++c) {
      double* out = H.column[c] + i;
      store(load(out) + (a0 * B.row[0][c] + a1 * B.row[1][c]), out);
    }
  }
}

inline void add_view(const PointRow& point, const PoseDerivative& J, PoseBlockSum& H, PoseSum& g,
                     CouplingSum& W) {
  add_pair(J, J, H);
  for (std::size_t i = 0; i < kPaddedPose; i += kWidth) {
    const Doubles j0 = load(J.row[0] + i), j1 = load(J.row[1] + i);
    store(load(g.entry + i) + (j0 * point.r[0] + j1 * point.r[1]), g.entry + i);
    for (std::size_t k = 0; k < 3; ++k) {
      double* out = W.row[k] + i;
      store(load(out) + (j0 * point.J[0][k] + j1 * point.J[1][k]), out);
    }
  }
}

inline void reduce(const ReducedLandmark& landmark, WindowLink& link, PoseSum& rhs) {
  const double(&L)[3][3] = landmark.inverse_root;
  for (std::size_t i = 0; i < kPaddedPose; i += kWidth) {
    const Doubles w0 = load(link.W.row[0] + i), w1 = load(link.W.row[1] + i),
                  w2 = load(link.W.row[2] + i);
    const Doubles r0 = w0 * L[0][0], r1 = w0 * L[1][0] + w1 * L[1][1],
                  r2 = w0 * L[2][0] + w1 * L[2][1] + w2 * L[2][2];
    store(r0, link.reduced.row[0] + i);
    store(r1, link.reduced.row[1] + i);
    store(r2, link.reduced.row[2] + i);
    const Doubles sum = r0 * landmark.g[0] + r1 * landmark.g[1] + r2 * landmark.g[2];
    store(load(rhs.entry + i) + sum, rhs.entry + i);
  }
}

/// S −= lowerᵀ upper.
inline void subtract_pair(const CouplingSum& lower, const CouplingSum& upper, PoseBlockSum& S) {
  for (std::size_t i = 0; i < kPaddedPose; i += kWidth) {
    const Doubles a0 = load(lower.row[0] + i), a1 = load(lower.row[1] + i),
                  a2 = load(lower.row[2] + i);
    for (std::size_t c = 0; c < kPoseNumbers; ++c) {
      double* out = S.column[c] + i;
      const Doubles sum = a0 * upper.row[0][c] + a1 * upper.row[1][c] + a2 * upper.row[2][c];
      store(load(out) - sum, out);
    }
  }
}

inline void eliminate(const ReducedLandmark& landmark, WindowLink* first, WindowLink* last,
                      PoseBlockSum* S, PoseSum* rhs) {
  for (WindowLink* link = first; link != last; ++link) {
    reduce(landmark, *link, rhs[link->view]);
    for (const WindowLink* other = first; other <= link; ++other) {
      if (link->view >= other->view) {
        subtract_pair(link->reduced, other->reduced, S[block_at(link->view, other->view)]);
      } else {
        subtract_pair(other->reduced, link->reduced, S[block_at(other->view, link->view)]);
      }
    }
  }
}

constexpr WindowKernels kWindowKernels{&add_view, &add_pair, &eliminate};

}  // namespace

template <>
const WindowKernels& simd_kernels_at<WindowKernels, kSimdLevel>() {
  return kWindowKernels;
}

}  // namespace oneac::internal
