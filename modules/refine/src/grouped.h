#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oneac {

/// Items by group, those of a group side by side and in the order in which they were added.
template <class Item>
class Grouped {
 public:
  /// Keeps the memory.
  void clear() {
    items_.clear();
    group_of_.clear();
  }
  void add(std::size_t group, const Item& item) {
    items_.push_back(item);
    group_of_.push_back(static_cast<std::uint32_t>(group));
  }
  /// To be called when all are added. @pre every group is below `groups`
  void sort(std::size_t groups) {
    first_.assign(groups + 1, 0);
    for (const std::uint32_t group : group_of_) ++first_[group + 1];
    for (std::size_t i = 0; i < groups; ++i) first_[i + 1] += first_[i];
    std::vector<std::size_t> next = first_;
    sorted_.resize(items_.size());
    for (std::size_t i = 0; i < items_.size(); ++i) sorted_[next[group_of_[i]]++] = items_[i];
  }
  [[nodiscard]] const Item* begin(std::size_t group) const {
    return sorted_.data() + first_[group];
  }
  [[nodiscard]] const Item* end(std::size_t group) const {
    return sorted_.data() + first_[group + 1];
  }

 private:
  std::vector<Item> items_, sorted_;
  std::vector<std::uint32_t> group_of_;
  std::vector<std::size_t> first_;  ///< per group; of the end, too
};

}  // namespace oneac
