#include "oneac/loops/graph_covariance.h"

#include "chain.h"
#include "selected_inverse.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace oneac {
namespace {

using internal::Matrix6;
using internal::Matrix63;
using internal::UncertainPose;
using internal::Vector6;

// [m] of way whose lengths are wrong by one factor: twice the 20 m over which the map forgets an
// error of its scale, so that errors add up alike over long ways.
constexpr double kStretch = 40.0;

/// A step or a loop, T_a_b, and the relative errors of its length and turn that it shares.
struct Edge {
  std::size_t a, b;
  UncertainPose pose;
  double length_of_all = 0.0, length_of_stretch = 0.0;
  std::size_t stretch = 0;
  Matrix63 rotations = Matrix63::Zero();  ///< see shared_changes()
};

/// The steps, with the stretch that each is of, counted over all logs.
std::vector<Edge> steps_of(const std::vector<LoopKeyframe>& keyframes,
                           const std::vector<Eigen::Isometry3d>& poses, double shared_length) {
  std::vector<Edge> edges;
  double way = 0.0;
  std::size_t stretch = 0;
  for (std::size_t i = 1; i < keyframes.size(); ++i) {
    const LoopKeyframe& keyframe = keyframes[i];
    const bool joined = keyframes[i - 1].log == keyframe.log;
    Edge edge{i - 1, i, {poses[i - 1].inverse() * poses[i], internal::covariance_of(keyframe)}};
    way += edge.pose.T.translation().norm();
    if (!joined || way > kStretch) {
      way = 0.0;
      ++stretch;
    }
    if (!joined) continue;
    edge.stretch = stretch;
    const double sigma = keyframe.scale_sigma;
    edge.length_of_all = std::min(sigma, shared_length);
    edge.length_of_stretch = std::sqrt(sigma * sigma - edge.length_of_all * edge.length_of_all);
    edge.rotations = internal::shared_changes(keyframe);
    edges.push_back(edge);
  }
  return edges;
}

/// The normal equations of changes on the right of the poses, the first of every frame fixed.
class Equations {
 public:
  Equations(const std::vector<std::size_t>& group, const std::vector<Edge>& edges) : edges_(edges) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      const bool fixed = group[i] == i;
      places_.push_back(fixed ? kFixed : size_);
      size_ += fixed ? 0 : 6;
    }
    for (const Edge& edge : edges) {
      const Matrix6 information = edge.pose.covariance.ldlt().solve(Matrix6::Identity());
      weights_.emplace_back(0.5 * (information + information.transpose()));
      back_.push_back(internal::adjoint(edge.pose.T.inverse()));
    }
  }

  [[nodiscard]] Eigen::Index size() const { return size_; }
  [[nodiscard]] Eigen::Index place(std::size_t keyframe) const { return places_[keyframe]; }
  [[nodiscard]] bool is_fixed(std::size_t keyframe) const { return places_[keyframe] == kFixed; }

  [[nodiscard]] internal::SelectedInverse::Matrix matrix() const {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const Matrix6 of_a = back_[i].transpose() * weights_[i];  // −(∂e/∂δa)ᵀ W
      put(edges_[i].a, edges_[i].a, of_a * back_[i], entries);
      put(edges_[i].b, edges_[i].b, weights_[i], entries);
      put(edges_[i].a, edges_[i].b, -of_a, entries);
      put(edges_[i].b, edges_[i].a, -of_a.transpose(), entries);
    }
    internal::SelectedInverse::Matrix A(size_, size_);
    A.setFromTriplets(entries.begin(), entries.end());
    return A;
  }

  /// What an error of the measurements makes of the right side.
  /// @param error  of an edge's pose, on its right
  template <class Error>
  [[nodiscard]] Eigen::VectorXd right_side(Error&& error) const {
    Eigen::VectorXd b = Eigen::VectorXd::Zero(size_);
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const Vector6 z = error(edges_[i]);
      if (z.isZero(0.0)) continue;
      const Vector6 weighted = weights_[i] * z;
      if (!is_fixed(edges_[i].a)) {
        b.segment<6>(place(edges_[i].a)) -= back_[i].transpose() * weighted;
      }
      if (!is_fixed(edges_[i].b)) b.segment<6>(place(edges_[i].b)) += weighted;
    }
    return b;
  }

 private:
  static constexpr Eigen::Index kFixed = -1;

  void put(std::size_t a, std::size_t b, const Matrix6& block,
           std::vector<Eigen::Triplet<double>>& entries) const {
    if (is_fixed(a) || is_fixed(b)) return;
    for (int row = 0; row < 6; ++row) {
      for (int column = 0; column < 6; ++column) {
        entries.emplace_back(static_cast<int>(place(a)) + row, static_cast<int>(place(b)) + column,
                             block(row, column));
      }
    }
  }

  const std::vector<Edge>& edges_;
  std::vector<Matrix6> weights_, back_;  ///< information; from a's right side to b's
  std::vector<Eigen::Index> places_;
  Eigen::Index size_ = 0;
};

/// The relative error of a pose's length, as a change on its right.
Vector6 longer(const Eigen::Isometry3d& T, double by) {
  Vector6 change = Vector6::Zero();
  change.head<3>() = by * (T.linear().transpose() * T.translation());
  return change;
}

Vector6 turned_more(const Eigen::Isometry3d& T, double by) {
  const Eigen::AngleAxisd turn(T.linear());
  Vector6 change = Vector6::Zero();
  change.tail<3>() = by * turn.angle() * turn.axis();
  return change;
}

/// Visits what each shared error of one σ does to all poses, one after the other: of a long drive
/// they would not fit into memory together.
template <class Visit>
void visit_shared_modes(const Equations& equations, const internal::SelectedInverse& inverse,
                        const std::vector<Edge>& edges, const SharedErrors& shared, Visit&& visit) {
  const auto mode = [&](auto&& error) { visit(inverse.times(equations.right_side(error))); };
  mode([](const Edge& edge) { return longer(edge.pose.T, edge.length_of_all); });
  mode([&](const Edge& edge) { return turned_more(edge.pose.T, shared.turn); });
  for (int axis = 0; axis < 3; ++axis) {
    mode([&](const Edge& edge) -> Vector6 { return edge.rotations.col(axis); });
  }
  std::size_t stretches = 0;
  for (const Edge& edge : edges) stretches = std::max(stretches, edge.stretch + 1);
  for (std::size_t stretch = 0; stretch < stretches; ++stretch) {
    mode([&](const Edge& edge) -> Vector6 {
      if (edge.stretch != stretch) return Vector6::Zero();
      return longer(edge.pose.T, edge.length_of_stretch);
    });
  }
}

/// Of a change (translation, rotation vector) on the right as one of (θ, p).
Matrix6 in_world(const Matrix6& covariance, const Eigen::Matrix3d& R) {
  Matrix6 M = Matrix6::Zero();
  M.topRightCorner<3, 3>() = R;
  M.bottomLeftCorner<3, 3>() = R;
  return M * covariance * M.transpose();
}

}  // namespace

std::vector<Matrix6> closed_covariances(const std::vector<LoopKeyframe>& keyframes,
                                        const ClosedGraph& graph, const SharedErrors& shared) {
  const auto& poses = graph.T_first_cam;
  std::vector<Matrix6> covariances(keyframes.size(), Matrix6::Zero());
  std::vector<Edge> edges = steps_of(keyframes, poses, shared.length);
  for (const LoopConstraint& loop : graph.loops) {
    edges.push_back({loop.first, loop.second, internal::of_loop(loop), shared.length});
  }
  const Equations equations(graph.group, edges);
  if (equations.size() == 0) return covariances;
  const auto inverse = internal::SelectedInverse::of(equations.matrix());
  if (!inverse) return covariances;
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    if (equations.is_fixed(k)) continue;
    const Eigen::Index at = equations.place(k);
    for (int row = 0; row < 6; ++row) {
      for (int column = 0; column < 6; ++column) {
        covariances[k](row, column) = inverse->at(at + row, at + column);
      }
    }
  }
  visit_shared_modes(equations, *inverse, edges, shared, [&](const Eigen::VectorXd& mode) {
    for (std::size_t k = 0; k < keyframes.size(); ++k) {
      if (equations.is_fixed(k)) continue;
      const auto change = mode.segment<6>(equations.place(k));
      covariances[k] += change * change.transpose();
    }
  });
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    if (!equations.is_fixed(k)) covariances[k] = in_world(covariances[k], poses[k].linear());
  }
  return covariances;
}

}  // namespace oneac
