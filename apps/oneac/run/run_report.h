#pragma once

#include "drive_record.h"
#include "run_options.h"
#include "run_summary.h"

#include <string>

namespace oneac::app {

/// The title of the section that holds all that depends on the clock; nothing follows it.
inline constexpr const char* kTimingHeading = "Timing";

/// report.html of a run: one file that needs nothing else. Way over the reference, curves over
/// time, worst frames as pictures (read from the log once more), the summary, timing last.
/// @param summary  the text of summary.json
/// @param closed   where loops were looked for: a section of its own
[[nodiscard]] std::string report_html(const DriveRecord& record, const RunEvaluation& evaluation,
                                      const RunOptions& options, const std::string& summary,
                                      const ClosedDrive* closed = nullptr);

}  // namespace oneac::app
