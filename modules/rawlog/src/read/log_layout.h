#pragma once

#include "oneac/rawlog/log_summary.h"

#include <string>

namespace oneac {

/// What should lie beside the log and does not, with a way to get each; "" when nothing is missing.
[[nodiscard]] std::string missing_lines(const LogSummary& summary);

}  // namespace oneac
