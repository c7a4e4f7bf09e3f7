#pragma once

#include "oneac/frontend/frame_result.h"
#include "oneac/frontend/suspension_tilt.h"

namespace oneac {

/// What a step says about the tilt of the camera against its road. @pre the images carried it
[[nodiscard]] TiltStep tilt_step(const StepResult& step);

}  // namespace oneac
