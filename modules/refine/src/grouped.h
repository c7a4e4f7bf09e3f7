#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace oneac {

/// Items by group, those of a group side by side and in the order in which they were added.
template <class Item>
class Grouped {
 public:
  void reserve(std::size_t items) {
    items_.reserve(items);
    group_of_.reserve(items);
  }
  void add(std::size_t group, const Item& item) {
    items_.push_back(item);
    group_of_.push_back(group);
  }
  /// To be called once, when all are added. @pre every group is below `groups`
  void sort(std::size_t groups) {
    first_.assign(groups + 1, 0);
    for (const std::size_t group : group_of_) ++first_[group + 1];
    for (std::size_t i = 0; i < groups; ++i) first_[i + 1] += first_[i];
    std::vector<std::size_t> next = first_;
    std::vector<Item> sorted(items_.size());
    for (std::size_t i = 0; i < items_.size(); ++i) sorted[next[group_of_[i]]++] = items_[i];
    items_ = std::move(sorted);
  }
  [[nodiscard]] const Item* begin(std::size_t group) const { return items_.data() + first_[group]; }
  [[nodiscard]] const Item* end(std::size_t group) const {
    return items_.data() + first_[group + 1];
  }

 private:
  std::vector<Item> items_;
  std::vector<std::size_t> group_of_;
  std::vector<std::size_t> first_;  ///< per group; of the end, too
};

}  // namespace oneac
