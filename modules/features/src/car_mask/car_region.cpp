#include "car_region.h"

#include "oneac/base/median.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace oneac::internal {
namespace {

constexpr int kGap = 2;           // [cells] a thing's resting cells lie no farther apart
constexpr int kBridge = 6;        // [columns] of an outline that may be missing
constexpr int kSmooth = 4;        // [columns] to each side of the outline's median
constexpr int kStep = 4;          // [cells] that an outline may rise or fall to the next piece
constexpr int kLongShare = 6;     // an outline as long as a sixth of the image is no speck
constexpr double kPassing = 0.5;  // of the cells below that show something

using Cells = std::vector<std::size_t>;

class Region {
 public:
  Region(const CellGrid& grid, const std::vector<CellState>& cells)
      : grid_(grid), cells_(cells), car_(grid.size(), false), seen_(grid.size(), false) {}

  std::vector<bool> grow() && {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (!cells_[i].rests || seen_[i]) continue;
      const Cells thing = thing_of(i);
      if (is_car(thing)) {
        for (const std::size_t cell : thing) car_[cell] = true;
      }
    }
    fill_below();
    return widened();
  }

 private:
  /// All resting cells that hang together with this one.
  Cells thing_of(std::size_t first) {
    Cells thing = {first};
    seen_[first] = true;
    for (std::size_t next = 0; next < thing.size(); ++next) {
      for_each_near(thing[next], kGap, [&](std::size_t cell) {
        if (seen_[cell] || !cells_[cell].rests) return;
        seen_[cell] = true;
        thing.push_back(cell);
      });
    }
    return thing;
  }

  [[nodiscard]] bool is_car(const Cells& thing) const {
    const auto any = [&](bool CellState::*what) {
      return std::any_of(thing.begin(), thing.end(),
                         [&](std::size_t cell) { return cells_[cell].*what; });
    };
    return any(&CellState::low) && !any(&CellState::distant);
  }

  /// Highest car cell of each column; rows when there is none.
  [[nodiscard]] std::vector<int> outline() const {
    std::vector<int> top(static_cast<std::size_t>(grid_.columns), grid_.rows);
    for (int column = 0; column < grid_.columns; ++column) {
      for (int row = grid_.rows - 1; row >= 0; --row) {
        if (car_[grid_.at(column, row)]) top[static_cast<std::size_t>(column)] = row;
      }
    }
    return top;
  }

  void fill_below() {
    const std::vector<int> top = outline();
    const auto has = [&](int column) { return top[static_cast<std::size_t>(column)] < grid_.rows; };
    for (int first = 0; first < grid_.columns; ++first) {
      if (!has(first)) continue;
      int last = first;
      for (int next = first + 1; next < grid_.columns && next - last <= kBridge; ++next) {
        if (has(next) && std::abs(height(top, next) - height(top, last)) <= kStep) last = next;
      }
      if ((last - first + 1) * kLongShare >= grid_.columns) fill_run(top, first, last);
      first = last;
    }
  }

  static int height(const std::vector<int>& top, int column) {
    return top[static_cast<std::size_t>(column)];
  }

  /// The outline of a run without gaps, single cells that stick out of it smoothed away, carried on
  /// to the image's border where it ends near it. A missing piece is as low as the lower end.
  [[nodiscard]] std::vector<int> smoothed(std::vector<int> top, int& first, int& last) const {
    for (int column = first + 1; column < last; ++column) {
      if (height(top, column) < grid_.rows) continue;
      int next = column;
      while (height(top, next) >= grid_.rows) ++next;
      top[static_cast<std::size_t>(column)] = std::max(height(top, column - 1), height(top, next));
    }
    std::vector<int> smooth = top;
    for (int column = first; column <= last; ++column) {
      const auto begin = top.begin() + std::max(first, column - kSmooth);
      const auto end = top.begin() + std::min(last, column + kSmooth) + 1;
      smooth[static_cast<std::size_t>(column)] =
          static_cast<int>(upper_median(std::vector<double>(begin, end)));
    }
    if (first <= kBridge) {
      std::fill_n(smooth.begin(), first, height(smooth, first));
      first = 0;
    }
    if (grid_.columns - 1 - last <= kBridge) {
      std::fill(smooth.begin() + last + 1, smooth.end(), height(smooth, last));
      last = grid_.columns - 1;
    }
    return smooth;
  }

  void fill_run(const std::vector<int>& outline, int first, int last) {
    const std::vector<int> top = smoothed(outline, first, last);
    int passing = 0, telling = 0;
    Cells below, enclosed;
    for (int column = first; column <= last; ++column) {
      const int lowest = lowest_rest(column);
      for (int row = height(top, column); row < grid_.rows; ++row) {
        const std::size_t cell = grid_.at(column, row);
        (row <= lowest ? enclosed : below).push_back(cell);
        passing += cells_[cell].moves ? 1 : 0;
        telling += cells_[cell].moves || cells_[cell].rests ? 1 : 0;
      }
    }
    for (const std::size_t cell : enclosed) car_[cell] = true;
    if (passing > kPassing * telling) return;
    for (const std::size_t cell : below) car_[cell] = true;
  }

  /// The lowest row where the car rests in this column or next to it, -1 where it does nowhere.
  /// What moves above it is a reflection in the bonnet.
  [[nodiscard]] int lowest_rest(int column) const {
    const int left = std::max(0, column - kGap), right = std::min(grid_.columns - 1, column + kGap);
    for (int row = grid_.rows - 1; row >= 0; --row) {
      for (int c = left; c <= right; ++c) {
        if (car_[grid_.at(c, row)] && cells_[grid_.at(c, row)].rests) return row;
      }
    }
    return -1;
  }

  [[nodiscard]] std::vector<bool> widened() const {
    std::vector<bool> wide = car_;
    for (std::size_t i = 0; i < car_.size(); ++i) {
      if (car_[i]) for_each_near(i, 1, [&](std::size_t cell) { wide[cell] = true; });
    }
    return wide;
  }

  template <class Visit>
  void for_each_near(std::size_t cell, int reach, Visit&& visit) const {
    const int column = static_cast<int>(cell) % grid_.columns;
    const int row = static_cast<int>(cell) / grid_.columns;
    for (int r = std::max(0, row - reach); r <= std::min(grid_.rows - 1, row + reach); ++r) {
      for (int c = std::max(0, column - reach); c <= std::min(grid_.columns - 1, column + reach);
           ++c) {
        visit(grid_.at(c, r));
      }
    }
  }

  const CellGrid& grid_;
  const std::vector<CellState>& cells_;
  std::vector<bool> car_, seen_;
};

}  // namespace

std::vector<bool> car_region(const CellGrid& grid, const std::vector<CellState>& cells) {
  return Region(grid, cells).grow();
}

}  // namespace oneac::internal
