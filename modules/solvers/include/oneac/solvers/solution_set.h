#pragma once

#include <array>
#include <cstddef>

namespace oneac {

/// At most N solutions, stored in place: what a minimal solver returns. Never holds NaN.
template <class Solution, std::size_t N>
class SolutionSet {
 public:
  static constexpr std::size_t kCapacity = N;

  SolutionSet() = default;
  SolutionSet(const Solution& only) { push_back(only); }  // NOLINT: a solution is a set of one

  /// @pre size() < N
  void push_back(const Solution& solution) { solutions_[size_++] = solution; }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] const Solution& operator[](std::size_t i) const { return solutions_[i]; }
  [[nodiscard]] Solution& operator[](std::size_t i) { return solutions_[i]; }
  [[nodiscard]] const Solution* begin() const { return solutions_.data(); }
  [[nodiscard]] const Solution* end() const { return solutions_.data() + size_; }

 private:
  std::array<Solution, N> solutions_{};
  std::size_t size_ = 0;
};

}  // namespace oneac
