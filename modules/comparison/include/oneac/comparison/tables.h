#pragma once

#include "oneac/comparison/summary.h"
#include "oneac/report/table.h"

#include <string>
#include <vector>

namespace oneac {

// The files of a comparison. Numbers read back exactly in pairs.csv; elsewhere they are rounded.
// Only timings.csv, the columns ms_… of summary.csv and the rows "Time" of the tables depend on the
// clock.

/// The log's name, or its number where it is not known.
[[nodiscard]] std::string name_of_log(const ComparisonData& data, std::size_t log);
/// One row per pair × method × trial.
[[nodiscard]] std::string pairs_csv(const ComparisonData& data);
/// The same keys with the CPU time [ms].
[[nodiscard]] std::string timings_csv(const ComparisonData& data);
/// One row per log × method, then the averages over logs.
[[nodiscard]] std::string summary_csv(const std::vector<MethodSummary>& rows);

/// A quantity of the table: methods down, logs and their average across, the best marked.
struct TableBlock {
  std::string title;  ///< with unit
  bool more_is_better = false;
  std::vector<std::string> methods;
  std::vector<std::string> logs;
  std::vector<std::vector<std::string>> cells;  ///< [method][log], "–" where empty
  std::vector<std::vector<bool>> best;
};

/// The layout of Table 1 of Gal 2020: time, rotation error, then what this comparison adds.
[[nodiscard]] std::vector<TableBlock> table_blocks(const std::vector<MethodSummary>& rows);
/// What a method's row shows of a log.
[[nodiscard]] Cell cell_of(const TableBlock& block, std::size_t method, std::size_t log);
/// All blocks as Markdown, the best of each column bold.
[[nodiscard]] std::string table_md(const std::vector<TableBlock>& blocks);
/// The same for LaTeX.
[[nodiscard]] std::string table_tex(const std::vector<TableBlock>& blocks);

}  // namespace oneac
