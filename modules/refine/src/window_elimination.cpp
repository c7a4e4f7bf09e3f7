#include "window_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

// Where the equations say nothing the damping still needs something to hold on to.
constexpr double kSmallestDiagonal = 1e-6;

double damp(double diagonal, double damping) {
  return damping * std::max(diagonal, kSmallestDiagonal);
}

}  // namespace

bool WindowEquations::eliminate(Landmark& landmark, double damping, Eigen::MatrixXd& S,
                                Eigen::VectorXd& rhs) {
  Eigen::Matrix3d H = landmark.H;
  for (int i = 0; i < 3; ++i) H(i, i) += damp(landmark.H(i, i), damping);
  const Eigen::LLT<Eigen::Matrix3d> llt(H);
  if (llt.info() != Eigen::Success) return false;
  landmark.inverse_root = llt.matrixL().solve(Eigen::Matrix3d::Identity());
  const Eigen::Vector3d g = landmark.inverse_root * landmark.g;
  for (std::size_t k = landmark.first_link; k < landmark.last_link; ++k) {
    Link& link = links_[k];
    link.reduced = landmark.inverse_root * link.W;
    rhs.segment<6>(link.column) += link.reduced.transpose() * g;
    for (std::size_t l = landmark.first_link; l <= k; ++l) {
      const Link& other = links_[l];
      if (link.column >= other.column) {
        S.block<6, 6>(link.column, other.column) -= link.reduced.transpose() * other.reduced;
      } else {
        S.block<6, 6>(other.column, link.column) -= other.reduced.transpose() * link.reduced;
      }
    }
  }
  return true;
}

std::optional<WindowStep> WindowEquations::solve(double damping) {
  Eigen::MatrixXd S = H_;
  Eigen::VectorXd rhs = -g_;
  for (std::ptrdiff_t i = 0; i < size_; ++i) S(i, i) += damp(H_(i, i), damping);
  for (Landmark& landmark : landmarks_) {
    if (landmark.empty()) continue;
    if (!eliminate(landmark, damping, S, rhs)) return std::nullopt;
  }
  const Eigen::LDLT<Eigen::MatrixXd, Eigen::Lower> ldlt(S);
  if (ldlt.info() != Eigen::Success || !ldlt.isPositive()) return std::nullopt;
  WindowStep step = back_substituted(ldlt.solve(rhs), damping);
  if (!std::isfinite(step.decrease)) return std::nullopt;
  return step;
}

WindowStep WindowEquations::back_substituted(const Eigen::VectorXd& poses, double damping) const {
  WindowStep step;
  step.poses = poses;
  // Of (H + λ D) δ = −g follows that the model falls by −g·δ / 2 + λ δ·D δ / 2.
  double twice = -g_.dot(step.poses);
  for (std::ptrdiff_t i = 0; i < size_; ++i) {
    twice += damp(H_(i, i), damping) * step.poses(i) * step.poses(i);
  }
  step.points.assign(landmarks_.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const Landmark& landmark = landmarks_[i];
    if (landmark.empty()) continue;
    Eigen::Vector3d left = landmark.inverse_root * landmark.g;
    for (std::size_t k = landmark.first_link; k < landmark.last_link; ++k) {
      left += links_[k].reduced * step.poses.segment<6>(links_[k].column);
    }
    Eigen::Vector3d& d = step.points[i];
    d = -(landmark.inverse_root.transpose() * left);
    twice -= landmark.g.dot(d);
    for (int j = 0; j < 3; ++j) twice += damp(landmark.H(j, j), damping) * d(j) * d(j);
  }
  step.decrease = 0.5 * twice;
  return step;
}

WindowState WindowEquations::moved(const WindowState& state, const WindowStep& step) const {
  WindowState result = state;
  for (std::size_t i = 0; i < views_; ++i) {
    if (columns_[i] < 0) continue;
    const Eigen::Matrix<double, 6, 1> d = step.poses.segment<6>(columns_[i]);
    RelativePose& pose = result.poses[i];
    pose.R = rotation_from_vector(d.head<3>()) * pose.R;
    pose.R = Eigen::Quaterniond(pose.R).normalized().toRotationMatrix();
    pose.t += d.tail<3>();
  }
  for (std::size_t i = 0; i < result.points.size(); ++i) result.points[i] += step.points[i];
  return result;
}

}  // namespace oneac
