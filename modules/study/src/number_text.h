#pragma once

#include <array>
#include <charconv>
#include <string>

namespace oneac::internal {

/// A number with so many significant digits, the same in every locale.
[[nodiscard]] inline std::string significant(double value, int digits) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value + 0.0,
                                 std::chars_format::general, digits);
  return {text.data(), end.ptr};
}

/// A number with so many decimals, the same in every locale.
[[nodiscard]] inline std::string decimals(double value, int digits) {
  std::array<char, 384> text{};  // the longest double has 309 digits before the point
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value + 0.0,
                                 std::chars_format::fixed, digits);
  return {text.data(), end.ptr};
}

}  // namespace oneac::internal
