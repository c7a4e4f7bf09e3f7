#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace oneac::internal {

/// Points in square bins, for "is any nearer than the bin's side".
class PointBins {
 public:
  PointBins(int width, int height, double side)
      : side_(side),
        columns_(static_cast<int>(width / side) + 3),
        rows_(static_cast<int>(height / side) + 3),
        newest_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -1) {}

  void add(const Eigen::Vector2d& u) {
    int& newest = newest_[bin(column(u), row(u))];
    points_.push_back({u, newest});
    newest = static_cast<int>(points_.size()) - 1;
  }

  /// @pre distance ≤ side
  [[nodiscard]] bool is_free(const Eigen::Vector2d& u, double distance) const {
    for (int r = row(u) - 1; r <= row(u) + 1; ++r) {
      for (int c = column(u) - 1; c <= column(u) + 1; ++c) {
        for (int i = newest_[bin(c, r)]; i >= 0; i = points_[static_cast<std::size_t>(i)].next) {
          if ((points_[static_cast<std::size_t>(i)].u - u).squaredNorm() < distance * distance) {
            return false;
          }
        }
      }
    }
    return true;
  }

 private:
  struct Entry {
    Eigen::Vector2d u;
    int next;
  };

  [[nodiscard]] int column(const Eigen::Vector2d& u) const {
    return std::clamp(static_cast<int>(u.x() / side_) + 1, 1, columns_ - 2);
  }
  [[nodiscard]] int row(const Eigen::Vector2d& u) const {
    return std::clamp(static_cast<int>(u.y() / side_) + 1, 1, rows_ - 2);
  }
  [[nodiscard]] std::size_t bin(int c, int r) const {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(c);
  }

  double side_;
  int columns_, rows_;
  std::vector<int> newest_;
  std::vector<Entry> points_;
};

}  // namespace oneac::internal
