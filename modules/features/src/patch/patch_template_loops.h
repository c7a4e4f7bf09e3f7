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

/// Rows of an image at one fraction of a pixel, the same for all samples, so that plain loads do;
/// each is interpolated along u once, for the sample above and the one below it.
struct ShiftedRows {
  const std::uint16_t* first;  ///< sample at the upper left
  std::int32_t stride;
  float fu, fv;

  ShiftedRows(const SampleGrid& grid, int reach) : stride(grid.stride) {
    const auto column = static_cast<std::int32_t>(grid.u), row = static_cast<std::int32_t>(grid.v);
    fu = grid.u - static_cast<float>(column);
    fv = grid.v - static_cast<float>(row);
    first = grid.data + ((row - reach) * grid.stride + column - reach + grid.origin);
  }

  /// Between the pixels of a row, a register from column x on.
  [[nodiscard]] Floats along(std::size_t y, std::size_t x) const {
    const std::uint16_t* from = first + static_cast<std::ptrdiff_t>(y) * stride + x;
    const Floats left = load_row(from);
    return left + fu * (load_row(from + 1) - left);
  }
  [[nodiscard]] Floats between(const Floats& top, const Floats& bottom) const {
    return top + fv * (bottom - top);
  }
};

/// The square around the window, interpolated.
inline void interpolate_square(const SampleGrid& grid, int reach, float* square) {
  const ShiftedRows rows(grid, reach);
  const std::size_t side = 2 * static_cast<std::size_t>(reach) + 1;
  for (std::size_t x = 0; x < side; x += kWidth) {
    Floats top = rows.along(0, x);
    for (std::size_t y = 0; y < side; ++y) {
      const Floats bottom = rows.along(y + 1, x);
      store(rows.between(top, bottom), square + y * kPatchStride + x);
      top = bottom;
    }
  }
}

/// The same through any A.
inline void warp_square(const SampleGrid& grid, int reach, float* square) {
  alignas(64) float columns[kPatchStride];
  for (int i = 0; i < static_cast<int>(kPatchStride); ++i) {
    // Lanes to the right of the square look at its last column, not out of the image.
    columns[i] = static_cast<float>(i < 2 * reach ? i - reach : reach);
  }
  const std::size_t side = 2 * static_cast<std::size_t>(reach) + 1;
  for (std::size_t y = 0; y < side; ++y) {
    const Floats row = Floats{} + static_cast<float>(static_cast<int>(y) - reach);
    for (std::size_t x = 0; x < side; x += kWidth) {
      store(sample(grid, load(columns + x), row), square + y * kPatchStride + x);
    }
  }
}

inline bool is_shift(const SampleGrid& grid) {
  return grid.a11 == 1.0F && grid.a12 == 0.0F && grid.a21 == 0.0F && grid.a22 == 1.0F;
}

/// Picks the window's samples, row by row; the last register of a row runs over into the next one,
/// which is written after it. What has no weight may lie outside the square: it becomes 0.
inline void pick_samples(const PatchWindow& window, const float* square, PatchTemplate& patch) {
  std::size_t next = 0;
  for (std::size_t y = 0; y < window.rows; ++y) {
    const float* row = square + (y * window.row_step + 1) * kPatchStride + window.row_begin[y];
    for (std::size_t x = 0; x < window.row_size[y]; x += kWidth) {
      const float* at = row + x;
      const std::size_t to = next + x;
      const Floats weight = load(window.weight + to);
      const auto keep = [&](const Floats& value, float* out) {
        store(weight > 0.0F ? value : Floats{}, out + to);
      };
      keep(load(at), patch.value);
      keep(0.5F * (load(at + 1) - load(at - 1)), patch.gx);
      keep(0.5F * (load(at + kPatchStride) - load(at - kPatchStride)), patch.gy);
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
  const int reach = window.reach() + 1;
  if (is_shift(grid)) {
    interpolate_square(grid, reach, square);
  } else {
    warp_square(grid, reach, square);
  }
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
