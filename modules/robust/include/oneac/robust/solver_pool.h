#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace oneac {

struct Solver;

/// The rows of the list of solvers that the one-AC consensus may take hypotheses from.
[[nodiscard]] const std::vector<const Solver*>& pool_solvers();

/// Which of the pool_solvers() are on.
struct SolverPool {
  static constexpr std::size_t kMost = 16;
  std::array<bool, kMost> on{};  ///< one per pool_solvers(), in their order

  /// As the rows say.
  SolverPool();
  /// That solver alone. @throws std::invalid_argument when it is none of the pool
  [[nodiscard]] static SolverPool only(const Solver& solver);
  /// As parameters: how many, and key and meaning of the i-th.
  [[nodiscard]] static std::size_t size();
  /// Key of the i-th solver in the section `consensus`.
  [[nodiscard]] static const char* key(std::size_t i);
  /// What that key switches on, in a line.
  [[nodiscard]] static std::string meaning(std::size_t i);
  /// Whether the solver of that key, such as "ground", is on.
  /// @throws std::invalid_argument when there is none
  [[nodiscard]] bool& operator[](std::string_view key);
};

}  // namespace oneac
