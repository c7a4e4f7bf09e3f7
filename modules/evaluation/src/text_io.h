#pragma once

#include <charconv>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oneac {

/// Of times in files: microseconds, more where a time has them.
inline constexpr int kTimeDecimals = 6;

/// A line of a text file without its end and surrounding blanks.
struct TextLine {
  std::size_t number = 0;  ///< counted from 1
  std::string_view text;
};

/// "file: line 3", for messages.
[[nodiscard]] std::string where_in(const std::string& file, std::size_t line);

/// The whole file. @throws InputError naming it when it does not exist, cannot be read, is empty
[[nodiscard]] std::string read_text(const std::filesystem::path& path);

/// Lines that are neither blank nor comments (#).
[[nodiscard]] std::vector<TextLine> data_lines(std::string_view text);

[[nodiscard]] std::vector<std::string_view> split_at_blanks(std::string_view line);
[[nodiscard]] std::vector<std::string_view> split_at_commas(std::string_view line);

/// The number that the whole field spells, in the C locale; empty when it is none, not finite or
/// not below 1e15: no length in metres and no time in seconds is, and its square would not be
/// finite.
[[nodiscard]] std::optional<double> parse_finite(std::string_view field);

/// Likewise for an integer.
template <class Integer>
[[nodiscard]] std::optional<Integer> parse_integer(std::string_view field) {
  Integer value{};
  const char* end = field.data() + field.size();
  const auto result = std::from_chars(field.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return value;
}

}  // namespace oneac
