#pragma once

#include "record_store.h"

#include <string>
#include <vector>

namespace oneac::app {

/// What the window says of the drive so far, a line each: frame and time, distance, whether the
/// last step is in metres. ASCII, which is what MRPT's fonts draw.
[[nodiscard]] std::vector<std::string> gui_lines(const FrameStore& frames);

}  // namespace oneac::app
