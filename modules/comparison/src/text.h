#pragma once

#include <string>
#include <vector>

namespace oneac::internal {

/// The shortest decimal text that reads back as the same double.
[[nodiscard]] std::string shortest(double value);
/// Fixed decimals; no "-0.00".
[[nodiscard]] std::string decimals(double value, int digits);
/// Three significant digits, no exponent between 0.001 and 1e6.
[[nodiscard]] std::string three_digits(double value);
[[nodiscard]] std::string base64(const std::vector<unsigned char>& bytes);

}  // namespace oneac::internal
