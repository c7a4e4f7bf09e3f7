#include "oneac/loops/pose_graph.h"

#include "chain.h"
#include "graph_edges.h"
#include "placement.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace oneac {
namespace {

using internal::Matrix6;
using internal::Vector6;

constexpr double kCauchy = 2.5;  // [σ of the whole residual] six Gaussian ones have a norm of 2.4
constexpr double kChi2 = 22.46;  // χ² of six degrees of freedom, 99.9 %
constexpr int kMostSolutions = 8;  // taking out what does not fit
constexpr int kIterations = 100;
constexpr double kTolerance = 1e-12;  // of the cost: well below a millimetre over a kilometre

/// Of a loop: against those that are false, or none, when what is left is believed as it stands.
enum class Loss { kRobust, kNone };

void add_loops(const std::vector<LoopConstraint>& loops, Loss loss,
               std::vector<internal::PoseBlock>& blocks, ceres::Problem& problem) {
  for (const LoopConstraint& loop : loops) {
    problem.AddResidualBlock(internal::loop_cost(loop),
                             loss == Loss::kRobust ? new ceres::CauchyLoss(kCauchy) : nullptr,
                             blocks[loop.first].data(), blocks[loop.second].data());
  }
}

/// As the odometry and the joins of parts have them.
void place(const std::vector<LoopKeyframe>& keyframes, ClosedGraph& graph) {
  internal::Placement placement = internal::place_parts(keyframes, graph.loops);
  graph.T_first_cam = std::move(placement.T_group_cam);
  graph.group = std::move(placement.group);
}

/// The first of every frame stays. @return whether the poses are those of the least squares
bool solve(const std::vector<LoopKeyframe>& keyframes, Loss loss, ClosedGraph& graph) {
  place(keyframes, graph);
  std::vector<internal::PoseBlock> blocks;
  for (const Eigen::Isometry3d& T : graph.T_first_cam) blocks.push_back(internal::to_block(T));
  ceres::Problem problem;
  internal::add_poses(blocks, graph.group, problem);
  internal::add_steps(keyframes, blocks, problem);
  add_loops(graph.loops, loss, blocks, problem);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = kIterations;
  options.function_tolerance = kTolerance;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return false;
  std::transform(blocks.begin(), blocks.end(), graph.T_first_cam.begin(), internal::to_pose);
  return true;
}

double squared_error(const LoopConstraint& loop, const std::vector<Eigen::Isometry3d>& poses) {
  const internal::UncertainPose measured = internal::of_loop(loop);
  const Vector6 e = internal::small_motion(measured.T.inverse() * poses[loop.first].inverse() *
                                           poses[loop.second]);
  return e.dot(measured.covariance.ldlt().solve(e));
}

/// @return whether there were loops that the poses disagree with
bool take_out_strange(const std::vector<Eigen::Isometry3d>& poses,
                      std::vector<LoopConstraint>& loops) {
  const auto strange = std::remove_if(loops.begin(), loops.end(), [&](const LoopConstraint& loop) {
    return squared_error(loop, poses) > kChi2;
  });
  const bool any = strange != loops.end();
  loops.erase(strange, loops.end());
  return any;
}

bool can_be_solved(const std::vector<LoopKeyframe>& keyframes) {
  for (const LoopKeyframe& keyframe : keyframes) {
    const Eigen::LLT<Matrix6> root(g2o_information(keyframe));
    if (root.info() != Eigen::Success || !keyframe.T_first_cam.matrix().allFinite()) return false;
  }
  return !keyframes.empty();
}

}  // namespace

ClosedGraph optimise_pose_graph(const std::vector<LoopKeyframe>& keyframes,
                                const std::vector<LoopConstraint>& loops) {
  ClosedGraph graph;
  graph.loops = loops;
  if (!can_be_solved(keyframes)) graph.loops.clear();
  Loss loss = Loss::kRobust;
  for (int round = 0; round < kMostSolutions && !graph.loops.empty(); ++round) {
    graph.usable = solve(keyframes, loss, graph);
    if (!graph.usable) break;
    if (take_out_strange(graph.T_first_cam, graph.loops)) continue;
    if (loss == Loss::kNone) return graph;
    loss = Loss::kNone;
  }
  // Nothing left to close by, or no agreement in sight.
  graph.loops.clear();
  place(keyframes, graph);
  return graph;
}

}  // namespace oneac
