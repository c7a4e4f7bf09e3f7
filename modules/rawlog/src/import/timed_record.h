#pragma once

#include "oneac/rawlog/rawlog_writer.h"

#include <functional>
#include <vector>

namespace oneac {

/// A record that is written when its turn comes.
struct TimedRecord {
  double time_s;
  std::function<void(RawlogWriter&)> write;
};

/// Writes by time; what has the same time stays in its order.
void write_in_order(std::vector<TimedRecord> records, RawlogWriter& log);

}  // namespace oneac
