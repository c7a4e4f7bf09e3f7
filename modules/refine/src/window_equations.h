#pragma once

#include "window_costs.h"
#include "window_kernels.h"

#include "oneac/refine/sliding_window.h"

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace oneac {

/// The unknowns of a window of points: poses and, per landmark, (x, y, ρ).
struct WindowState {
  std::vector<RelativePose> poses;
  std::vector<Eigen::Vector3d> points;
};

/// A step of the unknowns and by how much the quadratic model says it lowers the cost.
struct WindowStep {
  Eigen::VectorXd poses;  ///< (w, v) of each free view
  std::vector<Eigen::Vector3d> points;
  double decrease = 0.0;
  double chi2 = 0.0;  ///< squared distance that the poses go, in their standard deviations
};

/// Robust least squares over the points of a window and the planar-motion priors, affinities left
/// out: cost, normal equations and their solution by Schur elimination of the landmarks.
/// The same function as WindowProblem without affine terms, in less time: the transfer
/// from anchor to view is computed once per pair of views and nothing is allocated per observation.
class WindowEquations {
 public:
  WindowEquations(const SlidingWindow& window, const WindowRefineOptions& options);

  /// No landmark is seen by two views.
  [[nodiscard]] bool empty() const { return rows_.empty(); }
  /// ½ Σ ρ(|r|²); empty when a point is behind a view that sees it, or not finite.
  [[nodiscard]] std::optional<double> cost(const WindowState& state) const;
  /// Gauss–Newton equations, weighted by the slope of the loss.
  void linearise(const WindowState& state);
  /// Solves them with their diagonal raised by the share `damping`; empty when singular.
  [[nodiscard]] std::optional<WindowStep> solve(double damping);
  [[nodiscard]] WindowState moved(const WindowState& state, const WindowStep& step) const;

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  struct Row {  ///< one view's measurement of a landmark
    Eigen::Vector2d x;
    double inverse_sigma;
    std::size_t view;
    std::size_t link;  ///< of the view; kNone when it is fixed
  };
  struct Landmark {
    std::size_t anchor = 0;
    std::size_t anchor_link = kNone;
    std::size_t first_row = 0, last_row = 0;
    std::size_t first_link = 0, last_link = 0;
    [[nodiscard]] bool empty() const { return first_row == last_row; }
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    Eigen::Matrix3d inverse_root = Eigen::Matrix3d::Zero();  ///< L⁻¹ of the damped H = L Lᵀ
  };
  struct Transfer {
    Eigen::Matrix3d R;
    Eigen::Vector3d t;
  };
  struct Prior {
    std::size_t view;  ///< and the next one
    PlanarPrior prior;
  };

  void add_columns(const SlidingWindow& window);
  void add_rows(const SlidingWindow& window, const WindowRefineOptions& options);
  void add_priors(const SlidingWindow& window, const WindowRefineOptions& options);
  [[nodiscard]] std::size_t link_of(Landmark& landmark, std::size_t view);
  [[nodiscard]] std::vector<Transfer> transfers(const WindowState& state) const;
  void linearise_row(const Row& row, const Transfer& transfer, const WindowState& state,
                     const Eigen::Vector3d& point, Landmark& landmark);
  void add_view(const internal::PointRow& here, const internal::PoseDerivative& J,
                internal::WindowLink& link);
  void linearise_anchor(const Row& row, const Eigen::Vector3d& point, Landmark& landmark) const;
  void linearise_priors(const WindowState& state);
  [[nodiscard]] WindowStep back_substituted(const Eigen::VectorXd& poses, double damping) const;
  [[nodiscard]] bool eliminate(Landmark& landmark, double damping);
  /// Entry of the poses' equations, before damping.
  [[nodiscard]] double diagonal(std::size_t view, std::size_t k) const {
    return H_[internal::block_at(view, view)].column[k][k];
  }
  /// Of the reduced equations, for LDLᵀ: the lower triangle counts.
  [[nodiscard]] Eigen::MatrixXd reduced_matrix() const;
  [[nodiscard]] Eigen::VectorXd reduced_right_side() const;

  std::size_t views_;
  double c2_;                      ///< squared scale of the loss
  std::vector<std::size_t> free_;  ///< per view its index among the free ones; kNone when fixed
  std::size_t free_views_ = 0;
  std::vector<Landmark> landmarks_;
  std::vector<Row> rows_;
  std::vector<internal::WindowLink> links_;
  std::vector<Prior> priors_;
  std::vector<internal::PoseBlockSum> H_, S_;  ///< of poses, and reduced: on and below the diagonal
  std::vector<internal::PoseSum> g_, rhs_;
};

}  // namespace oneac
