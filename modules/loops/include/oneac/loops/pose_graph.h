#pragma once

#include "oneac/loops/loop_constraint.h"
#include "oneac/loops/loop_keyframe.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace oneac {

/// Keyframes after their loops were closed.
struct ClosedGraph {
  /// One per keyframe, in the frame of the first log of those that are joined.
  std::vector<Eigen::Isometry3d> T_first_cam;
  std::vector<std::size_t> group;  ///< per keyframe: the first of those in its frame, which stays
  std::vector<LoopConstraint> loops;  ///< those that the graph agrees with
  bool usable = true;  ///< false: the optimiser found nothing better, poses are the odometry's
};

/// Least squares over the poses of all keyframes: steps of the odometry and loops with their
/// information (Ceres, sparse Cholesky, one thread). A loop that lies beyond its own uncertainty is
/// taken out, first of a solution under a Cauchy loss; the last solution has none, so that it is
/// that of the graph as format_g2o() and format_g2o_loops() write it. Between two logs there is no
/// step: loops join them, or they have frames of their own.
[[nodiscard]] ClosedGraph optimise_pose_graph(const std::vector<LoopKeyframe>& keyframes,
                                              const std::vector<LoopConstraint>& loops);

}  // namespace oneac
