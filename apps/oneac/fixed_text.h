#pragma once

#include <string>

namespace oneac::app {

/// A number with so many decimals, in the C locale.
[[nodiscard]] std::string fixed_text(double value, int decimals);

}  // namespace oneac::app
