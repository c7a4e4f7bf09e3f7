#pragma once

#include <string>

namespace oneac {

// Numbers as text, the same in every locale. Minus zero reads as zero; NaN and infinity as "nan",
// "inf", "-inf".

/// The shortest text that reads back as the same number.
[[nodiscard]] std::string exact_text(double value);
[[nodiscard]] std::string exact_text(float value);

/// The same without an exponent and with at least `least_decimals`.
[[nodiscard]] std::string exact_fixed_text(double value, int least_decimals);

/// With this many decimals; never "-0.00".
[[nodiscard]] std::string fixed_text(double value, int decimals);

/// With this many significant digits at most: no zeros at the end, an exponent where it is shorter.
[[nodiscard]] std::string significant_text(double value, int digits);

/// Three significant digits, without exponent and with five decimals at most.
[[nodiscard]] std::string three_digits(double value);

}  // namespace oneac
