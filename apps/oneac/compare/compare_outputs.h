#pragma once

#include "oneac/comparison/pair_record.h"
#include "oneac/comparison/settings.h"

#include <filesystem>
#include <string>
#include <vector>

namespace oneac::app {

/// Writes pairs.csv, timings.csv, summary.csv, table.md, table.tex and report.html; each whole or
/// not at all. @param notes  sentences for the report @param pictures  of the worst pairs
void write_comparison(const ComparisonData& data, const CompareSettings& settings,
                      const std::vector<std::string>& notes, std::size_t pictures,
                      const std::filesystem::path& folder);

}  // namespace oneac::app
