#pragma once

#include "oneac/frontend/frame_result.h"
#include "oneac/frontend/suspension_pitch.h"
#include "oneac/frontend/tilt_estimator.h"

namespace oneac {

/// What a step says about the pitch of the camera. @pre the images carried it
/// @param tilt  the slow tilt; its roll tells the turn about the upright from pitching
[[nodiscard]] PitchStep pitch_step(const StepResult& step, const TiltBelief& tilt);

/// [rad] pitch up of the second view relative to the first, turns about the upright taken out.
[[nodiscard]] double pitch_turn(const RelativePose& T_2_1, const Tilt& tilt);

}  // namespace oneac
