#pragma once

#include "oneac/loops/loop_constraint.h"
#include "oneac/loops/loop_keyframe.h"

#include <string>
#include <vector>

namespace oneac {

/// `index1,index2,t1,t2,qw,qx,qy,qz,tx,ty,tz,sigma_length,inliers,acs`: X2 = R X1 + t [m], images
/// of the camera in the log as in relative_poses.csv. `log1,log2` at the end where the keyframes
/// are of several, numbered from 1.
[[nodiscard]] std::string format_loops(const std::vector<LoopConstraint>& loops,
                                       const std::vector<LoopKeyframe>& keyframes);

/// EDGE_SE3:QUAT of every loop, to stand behind the odometry's.
[[nodiscard]] std::string format_g2o_loops(const std::vector<LoopConstraint>& loops,
                                           const std::vector<LoopKeyframe>& keyframes);

}  // namespace oneac
