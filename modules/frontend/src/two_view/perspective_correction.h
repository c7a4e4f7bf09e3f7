#pragma once

#include "oneac/features/correspondence.h"
#include "oneac/geometry/relative_pose.h"

namespace oneac {

/// Moves the points of the second image from where affine alignment found them to where they are:
/// patches are seen in perspective, which the pose and their affinities tell. Correspondences that
/// do not tell their window (K = 0) stay as they are.
/// @param T_2_1  of the pair, |t| of any length
/// @param pair   normalised
[[nodiscard]] TrackedPair corrected_for_perspective(const RelativePose& T_2_1, TrackedPair pair);

}  // namespace oneac
