#pragma once

#include "road_polish.h"

#include "oneac/features/road_alignment.h"

namespace oneac::internal {

/// What a step says about the motion of the view with the template in the other one's axes.
/// @param forward    the template is the second view
/// @param direction  unit vector along step.T_2_1.t
[[nodiscard]] RoadPrior make_prior(const RoadStep& step, bool forward,
                                   const Eigen::Vector3d& direction,
                                   const RoadAlignmentOptions& options);

}  // namespace oneac::internal
