#include "oneac/loops/pose_graph.h"

#include "chain.h"
#include "placement.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
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

/// A pose as Ceres moves it: translation, then quaternion x y z w.
using Block = std::array<double, 7>;

Block to_block(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(T.linear()).normalized();
  return {
      T.translation().x(), T.translation().y(), T.translation().z(), q.x(), q.y(), q.z(), q.w()};
}

Eigen::Isometry3d to_pose(const Block& block) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(block[6], block[3], block[4], block[5]).normalized().matrix();
  T.translation() << block[0], block[1], block[2];
  return T;
}

/// A measured T_a_b in its standard deviations: translation and vector part of the quaternion of
/// what is left on its right, as g2o has it.
struct EdgeCost {
  Eigen::Vector3d t;
  Eigen::Quaterniond q;
  Matrix6 root;  ///< rootᵀ root = information

  template <class T>
  bool operator()(const T* a, const T* b, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    using Quaternion = Eigen::Quaternion<T>;
    const Eigen::Map<const Vector> ta(a), tb(b);
    const Eigen::Map<const Quaternion> qa(a + 3), qb(b + 3);
    const Vector between = qa.conjugate() * (tb - ta);
    const Quaternion measured = q.cast<T>();
    Eigen::Matrix<T, 6, 1> error;
    error.template head<3>() = measured.conjugate() * (between - t.cast<T>());
    Quaternion turn = measured.conjugate() * (qa.conjugate() * qb);
    if (turn.w() < T(0.0)) turn.coeffs() = -turn.coeffs();
    error.template tail<3>() = turn.vec();
    Eigen::Map<Eigen::Matrix<T, 6, 1>> out(residual);
    out = root.cast<T>() * error;
    return true;
  }
};

ceres::CostFunction* edge_cost(const Eigen::Isometry3d& T_a_b, const Matrix6& information) {
  const Matrix6 root = information.llt().matrixU();
  return new ceres::AutoDiffCostFunction<EdgeCost, 6, 7, 7>(
      new EdgeCost{T_a_b.translation(), Eigen::Quaterniond(T_a_b.linear()).normalized(), root});
}

Eigen::Isometry3d isometry(const RelativePose& pose) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = pose.R;
  T.translation() = pose.t;
  return T;
}

/// Of a loop: against those that are false, or none, when what is left is believed as it stands.
enum class Loss { kRobust, kNone };

void add_edges(const std::vector<LoopKeyframe>& keyframes, const std::vector<LoopConstraint>& loops,
               Loss loss, std::vector<Block>& blocks, ceres::Problem& problem) {
  for (Block& block : blocks) {
    problem.AddParameterBlock(
        block.data(), 7,
        new ceres::ProductManifold<ceres::EuclideanManifold<3>, ceres::EigenQuaternionManifold>());
  }
  for (std::size_t i = 1; i < keyframes.size(); ++i) {
    if (keyframes[i - 1].log != keyframes[i].log) continue;
    const Eigen::Isometry3d T = keyframes[i - 1].T_first_cam.inverse() * keyframes[i].T_first_cam;
    problem.AddResidualBlock(edge_cost(T, g2o_information(keyframes[i])), nullptr,
                             blocks[i - 1].data(), blocks[i].data());
  }
  for (const LoopConstraint& loop : loops) {
    problem.AddResidualBlock(edge_cost(isometry(loop.T_2_1.inverse()), g2o_information(loop)),
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
  std::vector<Block> blocks;
  for (const Eigen::Isometry3d& T : graph.T_first_cam) blocks.push_back(to_block(T));
  ceres::Problem problem;
  add_edges(keyframes, graph.loops, loss, blocks, problem);
  for (const std::size_t first : graph.group) {
    problem.SetParameterBlockConstant(blocks[first].data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = kIterations;
  options.function_tolerance = kTolerance;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return false;
  std::transform(blocks.begin(), blocks.end(), graph.T_first_cam.begin(), to_pose);
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
