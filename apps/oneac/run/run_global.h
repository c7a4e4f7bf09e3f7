#pragma once

#include "run_loops.h"

#include <vector>

namespace oneac::app {

/// Adjusts keyframes and patches of the closed drives together: poses of the graph, where map
/// points are, and the report of it. What was interrupted, or has no loop, stays as it is.
/// @pre closed.graph is of closed.keyframes, those of the drives one log after the other
void adjust_closed_drives(const std::vector<RecordedDrive>& drives, ClosedDrives& closed);

}  // namespace oneac::app
