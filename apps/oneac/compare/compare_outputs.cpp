#include "compare_outputs.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/printable.h"
#include "oneac/comparison/html_report.h"
#include "oneac/comparison/tables.h"

#include <iostream>

namespace oneac::app {

void write_comparison(const ComparisonData& data, const CompareSettings& settings,
                      const std::vector<std::string>& notes, std::size_t pictures,
                      const std::filesystem::path& folder) {
  const std::vector<MethodSummary> summary = summarise(data);
  const std::string table = table_md(table_blocks(summary));
  write_file_atomically(folder / "pairs.csv", pairs_csv(data));
  write_file_atomically(folder / "timings.csv", timings_csv(data));
  write_file_atomically(folder / "summary.csv", summary_csv(summary));
  write_file_atomically(folder / "table.md", table);
  write_file_atomically(folder / "table.tex", table_tex(table_blocks(summary)));
  std::vector<std::string> all_notes = notes;
  const std::vector<PairOverlay> overlays = draw_worst_pairs(data, settings, pictures);
  if (overlays.empty() && pictures > 0 && !data.pairs.empty()) {
    all_notes.emplace_back("The images are not at hand, so the worst pairs are not shown.");
  }
  write_file_atomically(folder / "report.html", html_report(data, summary, overlays, all_notes));
  std::cout << table << data.pairs.size() << " pairs x " << data.methods.size() << " methods x "
            << data.trials << (data.trials == 1 ? " trial" : " trials") << "; written to "
            << printable(folder.string())
            << ": pairs.csv, timings.csv, summary.csv, table.md, table.tex, report.html\n";
}

}  // namespace oneac::app
