#pragma once

#include <string>

namespace oneac {

/// "0.1.0 (abc123456)": the release, and the commit as git described it when the build was
/// configured ("-dirty" with changes, "unknown" outside a checkout).
[[nodiscard]] std::string version();

}  // namespace oneac
