#include "import/timed_record.h"

#include <algorithm>

namespace oneac {

void write_in_order(std::vector<TimedRecord> records, RawlogWriter& log) {
  std::stable_sort(records.begin(), records.end(),
                   [](const TimedRecord& a, const TimedRecord& b) { return a.time_s < b.time_s; });
  for (const TimedRecord& record : records) record.write(log);
}

}  // namespace oneac
