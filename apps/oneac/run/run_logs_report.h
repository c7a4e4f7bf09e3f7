#pragma once

#include "run_loops.h"

#include <string>
#include <vector>

namespace oneac::app {

/// "B.rawlog is not joined to …", a line per log that is not in the frame of the first.
[[nodiscard]] std::vector<std::string> about_logs_apart(const std::vector<RecordedDrive>& drives,
                                                        const ClosedDrives& closed);

/// summary.json of several logs: what each came to and the loops between them.
[[nodiscard]] std::string logs_summary_json(const std::vector<RecordedDrive>& drives,
                                            const ClosedDrives& closed, double wall_seconds);

/// report.html of several logs: those in the frame of the first on one map, a row for each.
[[nodiscard]] std::string logs_report_html(const std::vector<RecordedDrive>& drives,
                                           const ClosedDrives& closed);

/// The lines that `oneac run` prints about the logs together.
[[nodiscard]] std::string text_about_logs(const std::vector<RecordedDrive>& drives,
                                          const ClosedDrives& closed);

}  // namespace oneac::app
