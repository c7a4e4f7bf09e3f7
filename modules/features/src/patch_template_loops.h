#pragma once

#include "patch_lanes.h"

// Making a template, for patch_loops.h.
namespace oneac::internal {
namespace {

constexpr float kFlat = 1e-3F;  // [1/16 grey] below this a patch is constant up to rounding

template <std::size_t kCount>
struct PartialSums {
  alignas(64) float lanes[kCount][kPatchLanes];

  void keep(std::size_t sum, std::size_t slice, const Floats& value) {
    store(value, &lanes[sum][slice]);
  }
  [[nodiscard]] float operator[](std::size_t sum) const { return total(lanes[sum]); }
};

constexpr std::size_t kPatchStride = 48;  // side of the largest patch, rounded up to registers
constexpr std::size_t kPatchRows = 34;

/// The square around the window, interpolated. The fraction of a pixel is the same for all samples,
/// so that plain loads do.
inline void interpolate_square(const SampleGrid& grid, int reach, float* square) {
  const auto column = static_cast<std::int32_t>(grid.u), row = static_cast<std::int32_t>(grid.v);
  const float fu = grid.u - static_cast<float>(column), fv = grid.v - static_cast<float>(row);
  const std::int32_t first = (row - reach) * grid.stride + column - reach + grid.origin;
  const std::size_t side = 2 * static_cast<std::size_t>(reach) + 1;
  for (std::size_t y = 0; y < side; ++y) {
    const std::uint16_t* upper = grid.data + first + static_cast<std::int32_t>(y) * grid.stride;
    const std::uint16_t* lower = upper + grid.stride;
    for (std::size_t x = 0; x < side; x += kWidth) {
      const Floats upper_left = load_row(upper + x), lower_left = load_row(lower + x);
      const Floats top = upper_left + fu * (load_row(upper + x + 1) - upper_left);
      const Floats bottom = lower_left + fu * (load_row(lower + x + 1) - lower_left);
      store(top + fv * (bottom - top), square + y * kPatchStride + x);
    }
  }
}

/// Picks the window's samples, row by row; the last register of a row runs over into the next one,
/// which is written after it.
inline void pick_samples(const PatchWindow& window, const float* square, PatchTemplate& patch) {
  std::size_t next = 0;
  for (std::size_t y = 0; y < window.rows; ++y) {
    const float* row = square + (y + 1) * kPatchStride + window.row_begin[y];
    for (std::size_t x = 0; x < window.row_size[y]; x += kWidth) {
      const float* at = row + x;
      store(load(at), patch.value + next + x);
      store(0.5F * (load(at + 1) - load(at - 1)), patch.gx + next + x);
      store(0.5F * (load(at + kPatchStride) - load(at - kPatchStride)), patch.gy + next + x);
    }
    next += window.row_size[y];
  }
  for (; next < window.size; ++next) {
    patch.value[next] = patch.gx[next] = patch.gy[next] = 0.0F;
  }
}

inline float weighted_sum(const PatchWindow& window, const PatchTemplate& patch) {
  PartialSums<1> sums;
  for (std::size_t slice = 0; slice < kPatchLanes; slice += kWidth) {
    Floats sum = {};
    for (std::size_t i = slice; i < window.size; i += kPatchLanes) {
      sum += load(window.weight + i) * load(patch.value + i);
    }
    sums.keep(0, slice, sum);
  }
  return sums[0];
}

inline float variance(const PatchWindow& window, const PatchTemplate& patch) {
  PartialSums<1> sums;
  for (std::size_t slice = 0; slice < kPatchLanes; slice += kWidth) {
    Floats sum = {};
    for (std::size_t i = slice; i < window.size; i += kPatchLanes) {
      const Floats value = load(patch.value + i) - patch.mean;
      sum += load(window.weight + i) * value * value;
    }
    sums.keep(0, slice, sum);
  }
  return sums[0] / window.weight_sum;
}

inline void make_template(const SampleGrid& grid, const PatchWindow& window, PatchTemplate& patch) {
  alignas(64) float square[kPatchRows * kPatchStride];
  interpolate_square(grid, static_cast<int>(window.rows / 2) + 1, square);
  pick_samples(window, square, patch);
  patch.mean = weighted_sum(window, patch) / window.weight_sum;
  patch.contrast = __builtin_sqrtf(variance(window, patch));
  const float scale = patch.contrast > kFlat ? 1.0F / patch.contrast : 0.0F;
  for (std::size_t i = 0; i < window.size; i += kWidth) {
    store((load(patch.value + i) - patch.mean) * scale, patch.value + i);
    store(load(patch.gx + i) * scale, patch.gx + i);
    store(load(patch.gy + i) * scale, patch.gy + i);
  }
}

}  // namespace
}  // namespace oneac::internal
