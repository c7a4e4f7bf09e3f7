#pragma once

#include "chain.h"

#include "oneac/geometry/relative_pose.h"
#include "oneac/loops/loop_constraint.h"
#include "oneac/loops/loop_keyframe.h"

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <vector>

namespace ceres {
class CostFunction;
class Problem;
}  // namespace ceres

namespace oneac::internal {

/// A pose as Ceres moves it: translation, then quaternion x y z w.
using PoseBlock = std::array<double, 7>;

[[nodiscard]] PoseBlock to_block(const Eigen::Isometry3d& T);
[[nodiscard]] Eigen::Isometry3d to_pose(const PoseBlock& block);

/// The poses of keyframes as blocks of a problem, the first of every frame constant.
/// @param group  per keyframe the first of those in its frame
void add_poses(std::vector<PoseBlock>& blocks, const std::vector<std::size_t>& group,
               ceres::Problem& problem);

/// The odometry's step to every keyframe but the first of a log, with its covariance.
void add_steps(const std::vector<LoopKeyframe>& keyframes, std::vector<PoseBlock>& blocks,
               ceres::Problem& problem);

/// The edge of a loop.
[[nodiscard]] ceres::CostFunction* loop_cost(const LoopConstraint& loop);

}  // namespace oneac::internal
