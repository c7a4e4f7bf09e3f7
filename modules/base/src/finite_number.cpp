#include "oneac/base/finite_number.h"

#include <charconv>
#include <cmath>
#include <system_error>

namespace oneac {

std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

std::optional<double> finite_number(std::string_view text) {
  double value = 0.0;
  text = without_plus(text);
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  const bool whole = result.ec == std::errc() && result.ptr == end && std::isfinite(value);
  return whole ? std::optional(value) : std::nullopt;
}

}  // namespace oneac
