#pragma once

#include <string>

namespace oneac {

/// "0.1.0 (abc1234)": the release and the commit it was built from ("unknown" outside git).
[[nodiscard]] std::string version();

}  // namespace oneac
