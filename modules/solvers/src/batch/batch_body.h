#pragma once

#include "batch/batch_ground.h"
#include "batch/batch_kernels.h"
#include "batch/batch_planar.h"

namespace oneac::internal {
namespace {

inline AcLanes load_lanes(const BatchInput& in, std::size_t first) {
  return {load(in.entry[0] + first), load(in.entry[1] + first), load(in.entry[2] + first),
          load(in.entry[3] + first), load(in.entry[4] + first), load(in.entry[5] + first),
          load(in.entry[6] + first), load(in.entry[7] + first)};
}

inline void store_lanes(const PoseLanes& pose, const BatchOutput& out, std::size_t first) {
  store(pose.solved ? pose.cos_alpha : all(1.0), out.entry[0] + first);
  store(pose.solved ? pose.sin_alpha : all(0.0), out.entry[1] + first);
  store(pose.solved ? pose.tx : all(0.0), out.entry[2] + first);
  store(pose.solved ? pose.tz : all(0.0), out.entry[3] + first);
  // Masks have all bits or none: one of the three constants per lane, without a branch.
  constexpr std::int64_t kSolved = kBatchSolved, kEmpty = kBatchEmpty, kOpen = kBatchUndecided;
  const Mask status =
      (pose.solved & kSolved) | (pose.empty & kEmpty) | (~(pose.solved | pose.empty) & kOpen);
  for (std::size_t i = 0; i < kLanes<double>; ++i) {
    out.status[first + i] = static_cast<std::uint8_t>(status[i]);
  }
}

/// Whole groups of lanes in place, the rest in a copy padded with zeros.
template <PoseLanes (*kSolve)(const AcLanes&)>
inline void drive(const BatchInput& in, const BatchOutput& out, std::size_t size) {
  std::size_t first = 0;
  for (; first + kLanes<double> <= size; first += kLanes<double>) {
    store_lanes(kSolve(load_lanes(in, first)), out, first);
  }
  const std::size_t rest = size - first;
  if (rest == 0) return;
  double entries[8][kLanes<double>] = {};
  double poses[4][kLanes<double>];
  std::uint8_t status[kLanes<double>];
  for (std::size_t k = 0; k < 8; ++k) {
    for (std::size_t i = 0; i < rest; ++i) entries[k][i] = in.entry[k][first + i];
  }
  const BatchInput padded{{entries[0], entries[1], entries[2], entries[3], entries[4], entries[5],
                           entries[6], entries[7]}};
  store_lanes(kSolve(load_lanes(padded, 0)), {{poses[0], poses[1], poses[2], poses[3]}, status}, 0);
  for (std::size_t i = 0; i < rest; ++i) {
    for (std::size_t k = 0; k < 4; ++k) out.entry[k][first + i] = poses[k][i];
    out.status[first + i] = status[i];
  }
}

void ground(const BatchInput& in, const BatchOutput& out, std::size_t size) {
  drive<ground_poses>(in, out, size);
}

void planar(const BatchInput& in, const BatchOutput& out, std::size_t size) {
  drive<planar_poses>(in, out, size);
}

constexpr BatchKernels kBatchKernels{&ground, &planar};

}  // namespace

template <>
const BatchKernels& simd_kernels_at<BatchKernels, kSimdLevel>() {
  return kBatchKernels;
}

}  // namespace oneac::internal
