#pragma once

#include "drive_record.h"
#include "run_observer.h"
#include "run_options.h"

namespace oneac::app {

/// Runs the front-end over the log: decode and features on worker threads, estimation in order.
/// Stops early, keeping what it has, on an interrupt or an image that cannot be read.
/// @param observer  shown every frame on this thread; may be empty
/// @throws InputError when the log cannot be opened at all
[[nodiscard]] DriveRecord run_drive(const RunOptions& options, const RunObserver& observer = {});

}  // namespace oneac::app
