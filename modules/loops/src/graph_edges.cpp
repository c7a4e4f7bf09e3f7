#include "graph_edges.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>

namespace oneac::internal {
namespace {

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

}  // namespace

PoseBlock to_block(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(T.linear()).normalized();
  return {
      T.translation().x(), T.translation().y(), T.translation().z(), q.x(), q.y(), q.z(), q.w()};
}

Eigen::Isometry3d to_pose(const PoseBlock& block) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(block[6], block[3], block[4], block[5]).normalized().matrix();
  T.translation() << block[0], block[1], block[2];
  return T;
}

void add_poses(std::vector<PoseBlock>& blocks, const std::vector<std::size_t>& group,
               ceres::Problem& problem) {
  for (PoseBlock& block : blocks) {
    problem.AddParameterBlock(
        block.data(), 7,
        new ceres::ProductManifold<ceres::EuclideanManifold<3>, ceres::EigenQuaternionManifold>());
  }
  for (const std::size_t first : group) problem.SetParameterBlockConstant(blocks[first].data());
}

void add_steps(const std::vector<LoopKeyframe>& keyframes, std::vector<PoseBlock>& blocks,
               ceres::Problem& problem) {
  for (std::size_t i = 1; i < keyframes.size(); ++i) {
    if (keyframes[i - 1].log != keyframes[i].log) continue;
    const Eigen::Isometry3d T = keyframes[i - 1].T_first_cam.inverse() * keyframes[i].T_first_cam;
    problem.AddResidualBlock(edge_cost(T, g2o_information(keyframes[i])), nullptr,
                             blocks[i - 1].data(), blocks[i].data());
  }
}

ceres::CostFunction* loop_cost(const LoopConstraint& loop) {
  return edge_cost(isometry(loop.T_2_1.inverse()), g2o_information(loop));
}

}  // namespace oneac::internal
