#pragma once

#include "drive_record.h"
#include "run_loops.h"
#include "run_options.h"

namespace oneac::app {

/// Whether the drive teaches the focal length, so that camera.ini is written.
[[nodiscard]] bool learns_camera(const RunOptions& options);

/// Every file of a run, to the folder of `options`, and to stdout what it came to.
/// @param closed  where loops were looked for, else null
void write_results(const DriveRecord& record, const ClosedDrive* closed, RunOptions& options,
                   double wall_seconds);

/// Notes about the drive, to stderr unless the user wants none.
void tell_notes(const DriveRecord& record, const ClosedDrive* closed, const RunOptions& options);

}  // namespace oneac::app
