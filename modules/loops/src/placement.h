#pragma once

#include "oneac/loops/loop_constraint.h"
#include "oneac/loops/loop_keyframe.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace oneac::internal {

/// Where keyframes lie before anything is optimised.
struct Placement {
  std::vector<Eigen::Isometry3d> T_group_cam;  ///< one per keyframe
  std::vector<std::size_t> group;              ///< the first keyframe of those in one frame
};

/// Puts the parts of the way (Chain) into one frame where loops join them: along the pairs of parts
/// with the most loops; parts of one log that no loop joins stay as the odometry guesses. What is
/// joined to nothing before it has a frame of its own: that of its log.
[[nodiscard]] Placement place_parts(const std::vector<LoopKeyframe>& keyframes,
                                    const std::vector<LoopConstraint>& loops);

}  // namespace oneac::internal
