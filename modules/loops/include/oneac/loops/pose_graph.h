#pragma once

#include "oneac/loops/loop_constraint.h"
#include "oneac/loops/loop_keyframe.h"

#include <Eigen/Geometry>

#include <vector>

namespace oneac {

/// Keyframes after their loops were closed.
struct ClosedGraph {
  std::vector<Eigen::Isometry3d> T_first_cam;  ///< one per keyframe; the first stays
  std::vector<LoopConstraint> loops;           ///< those that the graph agrees with
  bool usable = true;  ///< false: the optimiser found nothing better, poses are the odometry's
};

/// Least squares over the poses of all keyframes: steps of the odometry and loops with their
/// information (Ceres, sparse Cholesky, one thread). A loop that lies beyond its own uncertainty is
/// taken out, first of a solution under a Cauchy loss; the last solution has none, so that it is
/// that of the graph as format_g2o() and format_g2o_loops() write it.
[[nodiscard]] ClosedGraph optimise_pose_graph(const std::vector<LoopKeyframe>& keyframes,
                                              const std::vector<LoopConstraint>& loops);

}  // namespace oneac
