#include "oneac/base/finite_number.h"

#include <charconv>
#include <cmath>
#include <system_error>

namespace oneac {

std::optional<double> finite_number(std::string_view text) {
  double value = 0.0;
  // from_chars knows no plus.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  const bool whole = result.ec == std::errc() && result.ptr == end && std::isfinite(value);
  return whole ? std::optional(value) : std::nullopt;
}

}  // namespace oneac
