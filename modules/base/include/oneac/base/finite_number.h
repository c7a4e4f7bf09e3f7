#pragma once

#include <optional>
#include <string_view>

namespace oneac {

/// The text of a number without its plus, which std::from_chars refuses; "+-1" stays as it is.
[[nodiscard]] std::string_view without_plus(std::string_view text);

/// The decimal number that a text is, with nothing but a sign before it and nothing behind it; none
/// for NaN and infinity.
[[nodiscard]] std::optional<double> finite_number(std::string_view text);

}  // namespace oneac
