#pragma once

#include "oneac/comparison/overlay.h"
#include "oneac/comparison/tables.h"

#include <string>
#include <vector>

namespace oneac {

/// One HTML page that needs nothing else: CDFs, the table, the worst pairs with their inliers,
/// every pair's errors. Light or dark as the reader's system is.
/// @param notes  sentences under the title: interruption, damage, what is missing
[[nodiscard]] std::string html_report(const ComparisonData& data,
                                      const std::vector<MethodSummary>& summary,
                                      const std::vector<PairOverlay>& overlays,
                                      const std::vector<std::string>& notes);

}  // namespace oneac
