#pragma once

#include "grouped.h"
#include "window_costs.h"
#include "window_kernels.h"

#include "oneac/base/workers.h"
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
///
/// Workers share what is of one landmark, then what goes into one block of the poses' equations;
/// each block is summed over the landmarks in their order, so that every sum is that of one thread.
class WindowEquations {
 public:
  explicit WindowEquations(Workers& workers) : workers_(workers) {}
  WindowEquations(const WindowEquations&) = delete;
  WindowEquations& operator=(const WindowEquations&) = delete;

  /// Takes a window, in the memory of the one before: a window's megabytes are asked for once.
  void set(const SlidingWindow& window, const WindowRefineOptions& options);
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
  struct RowTerms {  ///< residuals of a row as linearised
    internal::PointRow here;
    internal::PoseDerivative by_view, by_anchor;
  };
  struct Block {  ///< of the poses' equations
    std::size_t row, column;
    [[nodiscard]] bool is_diagonal() const { return row == column; }
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
  /// Who adds to which block.
  void add_blocks();
  void add_derivatives(const Landmark& landmark);
  void add_couplings(std::size_t landmark);
  [[nodiscard]] std::vector<Transfer> transfers(const WindowState& state) const;
  /// ρ(|r|²) of each row of a landmark; false when the point is behind a view.
  [[nodiscard]] bool row_costs(std::size_t landmark, const std::vector<Transfer>& all,
                               const WindowState& state, std::vector<double>& costs) const;
  void linearise_landmark(std::size_t i, const std::vector<Transfer>& all,
                          const WindowState& state);
  void linearise_row(const Row& row, const Transfer& transfer, const WindowState& state,
                     const Eigen::Vector3d& point, Landmark& landmark, RowTerms& terms);
  void linearise_anchor(const Row& row, const Eigen::Vector3d& point, Landmark& landmark) const;
  void linearise_priors(const WindowState& state);
  [[nodiscard]] WindowStep back_substituted(const Eigen::VectorXd& poses, double damping) const;
  /// A landmark's step for that of the poses.
  [[nodiscard]] Eigen::Vector3d back_substituted(const Landmark& landmark,
                                                 const Eigen::VectorXd& poses) const;
  /// False when the landmark's equations are singular.
  [[nodiscard]] bool reduce(std::size_t landmark, double damping);
  /// Entry of the poses' equations, before damping.
  [[nodiscard]] double diagonal(std::size_t view, std::size_t k) const {
    return H_[internal::block_at(view, view)].column[k][k];
  }
  /// Of the reduced equations, for LDLᵀ: the lower triangle counts.
  [[nodiscard]] Eigen::MatrixXd reduced_matrix() const;
  [[nodiscard]] Eigen::VectorXd reduced_right_side() const;

  std::size_t views_ = 0;
  double c2_ = 0.0;                ///< squared scale of the loss
  std::vector<std::size_t> free_;  ///< per view its index among the free ones; kNone when fixed
  std::size_t free_views_ = 0;
  std::vector<Landmark> landmarks_;
  Grouped<std::size_t> seen_by_;  ///< observations by landmark
  std::vector<Row> rows_;
  std::vector<internal::WindowLink> links_;
  std::vector<Prior> priors_;
  std::vector<RowTerms> terms_;                     ///< per row
  std::vector<internal::ReducedLandmark> reduced_;  ///< per landmark
  std::vector<Block> blocks_;                       ///< as block_at() has them
  Grouped<internal::DerivativePair> derivatives_;   ///< by block
  Grouped<internal::CouplingPair> couplings_;       ///< by block
  std::vector<internal::PoseBlockSum> H_, S_;  ///< of poses, and reduced: on and below the diagonal
  std::vector<internal::PoseSum> g_, rhs_;
  Workers& workers_;
};

}  // namespace oneac
