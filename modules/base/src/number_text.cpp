#include "oneac/base/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

namespace oneac {
namespace {

// The longest double without an exponent: 309 digits before the point, and its decimals.
constexpr std::size_t kLongest = 1500;

template <class Number, class... Format>
std::string text_of(Number value, Format... format) {
  std::array<char, kLongest> buffer;
  char* const end = buffer.data() + buffer.size();
  const auto result = std::to_chars(buffer.data(), end, value + Number(0), format...);  // -0 + 0
  return {buffer.data(), result.ptr};
}

}  // namespace

std::string exact_text(double value) {
  return text_of(value);
}

std::string exact_text(float value) {
  return text_of(value);
}

std::string exact_fixed_text(double value, int least_decimals) {
  std::string text = text_of(value, std::chars_format::fixed);
  if (!std::isfinite(value)) return text;
  if (text.find('.') == std::string::npos) text += '.';
  const std::size_t decimals = text.size() - text.find('.') - 1;
  const auto least = static_cast<std::size_t>(least_decimals);
  return text.append(least - std::min(least, decimals), '0');
}

std::string fixed_text(double value, int decimals) {
  std::string text = text_of(value, std::chars_format::fixed, decimals);
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  if (is_zero && text.front() == '-') text.erase(0, 1);
  return text;
}

std::string significant_text(double value, int digits) {
  return text_of(value, std::chars_format::general, digits);
}

std::string three_digits(double value) {
  if (!(std::abs(value) > 0.0)) return std::isnan(value) ? "nan" : "0";
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  return fixed_text(value, std::clamp(2 - exponent, 0, 5));
}

}  // namespace oneac
