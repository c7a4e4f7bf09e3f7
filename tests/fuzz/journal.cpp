// The journal of oneac compare; what is accepted can be merged and made tables of.
#include "oneac/comparison/journal.h"

#include "fuzz.h"

#include "oneac/base/error.h"
#include "oneac/comparison/method_faults.h"
#include "oneac/comparison/summary.h"
#include "oneac/comparison/tables.h"

ONEAC_FUZZ_TARGET(journal) {
  using namespace oneac;
  JournalContent content;
  try {
    content = read_journal(fuzz::file_with(data));
  } catch (const InputError&) {  // what it may throw
    return;
  }
  if (content.settings.empty()) return;  // not begun
  const CompareSettings settings = settings_of(content);
  fuzz::check(settings.fingerprint() == content.settings, "settings survive a round trip");
  const ComparisonData merged = merge_journals(settings, {content});
  fuzz::check(merged.pairs.size() == content.pairs.size(), "every pair is merged");
  static_cast<void>(missing_in({content}, merged));
  static_cast<void>(method_faults(merged));
  for (const PairRecord& pair : merged.pairs) {
    for (const MethodResult& result : pair.results) {
      fuzz::check(result.method < merged.methods.size(), "methods exist");
      fuzz::check(!result.has_pose || result.pose.is_finite(), "finite poses");
    }
  }
  fuzz::check(pairs_csv(merged).find("nan") == std::string::npos, "no NaN in a table");
  static_cast<void>(table_md(table_blocks(summarise(merged))));
}
