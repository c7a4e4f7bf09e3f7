#pragma once

#include "run_options.h"

#include <string>
#include <vector>

namespace oneac::app {

/// Runs several logs one after the other, each to a folder of its own (1, 2, … of options.output),
/// then joins them where they saw the same places: loops.csv, graph.g2o, map and report of all.
/// @throws InputError for logs that cannot be joined: given twice, of different cameras, without
/// --loops, with a reference that belongs to one; else as a run of one log, when all is written
void run_logs(const std::vector<std::string>& logs, const RunOptions& options);

}  // namespace oneac::app
