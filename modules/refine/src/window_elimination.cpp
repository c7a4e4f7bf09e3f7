#include "window_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace oneac {
namespace {

using internal::PoseSum;
using internal::ReducedLandmark;
using internal::simd_kernels;
using internal::WindowKernels;

// Where the equations say nothing the damping still needs something to hold on to.
constexpr double kSmallestDiagonal = 1e-6;

double damp(double diagonal, double damping) {
  return damping * std::max(diagonal, kSmallestDiagonal);
}

}  // namespace

bool WindowEquations::reduce(std::size_t i, double damping) {
  Landmark& landmark = landmarks_[i];
  Eigen::Matrix3d H = landmark.H;
  for (int k = 0; k < 3; ++k) H(k, k) += damp(landmark.H(k, k), damping);
  const Eigen::LLT<Eigen::Matrix3d> llt(H);
  if (llt.info() != Eigen::Success) return false;
  landmark.inverse_root = llt.matrixL().solve(Eigen::Matrix3d::Identity());
  const Eigen::Vector3d g = landmark.inverse_root * landmark.g;
  ReducedLandmark& reduced = reduced_[i];
  for (int k = 0; k < 3; ++k) {
    reduced.g[k] = g(k);
    for (int j = 0; j <= k; ++j) reduced.inverse_root[k][j] = landmark.inverse_root(k, j);
  }
  simd_kernels<WindowKernels>().reduce(reduced, links_.data() + landmark.first_link,
                                       links_.data() + landmark.last_link);
  return true;
}

Eigen::MatrixXd WindowEquations::reduced_matrix() const {
  const auto size = static_cast<Eigen::Index>(6 * free_views_);
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t row = 0; row < free_views_; ++row) {
    for (std::size_t column = 0; column <= row; ++column) {
      const internal::PoseBlockSum& block = S_[internal::block_at(row, column)];
      for (std::size_t c = 0; c < 6; ++c) {
        const auto to = static_cast<Eigen::Index>(6 * column + c);
        std::copy_n(block.column[c], 6, &S(static_cast<Eigen::Index>(6 * row), to));
      }
    }
  }
  return S;
}

Eigen::VectorXd WindowEquations::reduced_right_side() const {
  Eigen::VectorXd rhs(static_cast<Eigen::Index>(6 * free_views_));
  for (std::size_t i = 0; i < free_views_; ++i) std::copy_n(rhs_[i].entry, 6, rhs.data() + 6 * i);
  return rhs;
}

std::optional<WindowStep> WindowEquations::solve(double damping) {
  S_ = H_;
  rhs_ = g_;
  for (std::size_t i = 0; i < free_views_; ++i) {
    for (double& entry : rhs_[i].entry) entry = -entry;
    for (std::size_t k = 0; k < 6; ++k) {
      S_[internal::block_at(i, i)].column[k][k] += damp(diagonal(i, k), damping);
    }
  }
  std::atomic<bool> is_singular{false};
  workers_.share(landmarks_.size(), [&](std::size_t i, std::size_t) {
    if (!landmarks_[i].empty() && !reduce(i, damping)) is_singular = true;
  });
  if (is_singular) return std::nullopt;
  workers_.share(blocks_.size(), [&](std::size_t i, std::size_t) {
    PoseSum* const rhs = blocks_[i].is_diagonal() ? &rhs_[blocks_[i].row] : nullptr;
    simd_kernels<WindowKernels>().take_pairs(couplings_.begin(i), couplings_.end(i), S_[i], rhs);
  });
  const Eigen::MatrixXd S = reduced_matrix();
  const Eigen::LDLT<Eigen::MatrixXd, Eigen::Lower> ldlt(S);
  if (ldlt.info() != Eigen::Success || !ldlt.isPositive()) return std::nullopt;
  WindowStep step = back_substituted(ldlt.solve(reduced_right_side()), damping);
  step.chi2 = step.poses.dot(S.selfadjointView<Eigen::Lower>() * step.poses);
  if (!std::isfinite(step.decrease) || !std::isfinite(step.chi2)) return std::nullopt;
  return step;
}

WindowStep WindowEquations::back_substituted(const Eigen::VectorXd& poses, double damping) const {
  WindowStep step;
  step.poses = poses;
  // Of (H + λ D) δ = −g follows that the model falls by −g·δ / 2 + λ δ·D δ / 2.
  double twice = 0.0;
  for (std::size_t i = 0; i < free_views_; ++i) {
    for (std::size_t k = 0; k < 6; ++k) {
      const double d = step.poses(static_cast<Eigen::Index>(6 * i + k));
      twice += (damp(diagonal(i, k), damping) * d - g_[i].entry[k]) * d;
    }
  }
  step.points.assign(landmarks_.size(), Eigen::Vector3d::Zero());
  workers_.share(landmarks_.size(), [&](std::size_t i, std::size_t) {
    if (!landmarks_[i].empty()) step.points[i] = back_substituted(landmarks_[i], poses);
  });
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const Landmark& landmark = landmarks_[i];
    if (landmark.empty()) continue;
    const Eigen::Vector3d& d = step.points[i];
    twice -= landmark.g.dot(d);
    for (int j = 0; j < 3; ++j) twice += damp(landmark.H(j, j), damping) * d(j) * d(j);
  }
  step.decrease = 0.5 * twice;
  return step;
}

Eigen::Vector3d WindowEquations::back_substituted(const Landmark& landmark,
                                                  const Eigen::VectorXd& poses) const {
  Eigen::Vector3d left = landmark.inverse_root * landmark.g;
  for (std::size_t k = landmark.first_link; k < landmark.last_link; ++k) {
    const double* pose = poses.data() + 6 * links_[k].view;
    for (int j = 0; j < 3; ++j) {
      for (int c = 0; c < 6; ++c) left(j) += links_[k].reduced.row[j][c] * pose[c];
    }
  }
  return -(landmark.inverse_root.transpose() * left);
}

WindowState WindowEquations::moved(const WindowState& state, const WindowStep& step) const {
  WindowState result = state;
  for (std::size_t i = 0; i < views_; ++i) {
    if (free_[i] == kNone) continue;
    const Eigen::Matrix<double, 6, 1> d =
        step.poses.segment<6>(static_cast<Eigen::Index>(6 * free_[i]));
    RelativePose& pose = result.poses[i];
    pose.R = rotation_from_vector(d.head<3>()) * pose.R;
    pose.R = Eigen::Quaterniond(pose.R).normalized().toRotationMatrix();
    pose.t += d.tail<3>();
  }
  for (std::size_t i = 0; i < result.points.size(); ++i) result.points[i] += step.points[i];
  return result;
}

}  // namespace oneac
