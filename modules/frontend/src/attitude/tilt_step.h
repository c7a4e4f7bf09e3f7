#pragma once

#include "two_view/two_view.h"

#include "oneac/frontend/frame_result.h"
#include "oneac/frontend/suspension_tilt.h"

#include <optional>

namespace oneac {

/// What a step says about the tilt of the camera against its road. @pre the images carried it
[[nodiscard]] TiltStep tilt_step(const StepResult& step);

/// The way of a step whose length nobody has told yet, in its first view; empty when the images do
/// not tell one.
[[nodiscard]] std::optional<TiltStep::Travel> travel_in_first_view(const TwoView& seen);

}  // namespace oneac
