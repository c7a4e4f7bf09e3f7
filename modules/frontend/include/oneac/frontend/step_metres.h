#pragma once

#include "oneac/frontend/frame_result.h"

namespace oneac {

/// The step as it is without metres: |t| = 1 or 0, nothing known along t.
void withdraw_metres(StepResult& step);

/// Whether a length that is metric by itself stays so with a doubt that all lengths share. One that
/// is less sure in proportion than the bound, as the centimetres of a car that moves off, is judged
/// by its own measure already; the doubt alone is held against the bound then.
/// @param own_sigma, doubt  relative 1σ
[[nodiscard]] bool is_sure(double own_sigma, double doubt, double max_uncertainty);

/// States the doubt of the camera as it stands at the end of a drive in a step that was measured
/// before the drive had told it.
/// @param doubt           relative 1σ that lengths have by the camera, CameraBelief::doubt
/// @param max_uncertainty relative 1σ up to which a length counts as metric
/// @post step.camera_doubt = doubt; not metric where the length is less sure than the bound
void doubt_metres(StepResult& step, double doubt, double max_uncertainty);

}  // namespace oneac
