#pragma once

#include "window_costs.h"

#include "oneac/refine/sliding_window.h"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <deque>
#include <vector>

namespace oneac {

/// The Ceres problem of a window, affinities included when asked; owns the numbers that Ceres works
/// on.
class WindowProblem {
 public:
  WindowProblem(const SlidingWindow& window, const WindowRefineOptions& options);

  /// Nothing observed or nothing free.
  [[nodiscard]] bool empty() const;
  ceres::Solver::Summary solve(int max_iterations, double function_tolerance);
  [[nodiscard]] bool is_finite() const;
  /// Copies the solution back.
  void store(SlidingWindow& window) const;

 private:
  [[nodiscard]] double* pose(std::size_t view) { return &poses_[7 * view]; }
  [[nodiscard]] double* landmark(std::size_t i) { return &landmarks_[5 * i]; }
  void add_views(const SlidingWindow& window);
  void add_observation(const SlidingWindow& window, const WindowObservation& seen,
                       const WindowRefineOptions& options);
  void add_point(const WindowObservation& seen, std::size_t anchor, double sigma, bool patch);
  void add_planar_priors(const SlidingWindow& window, const WindowRefineOptions& options);

  std::vector<double> poses_;      ///< 7 per view
  std::vector<double> landmarks_;  ///< 5 per landmark, 3 in use for points
  std::vector<bool> is_patch_;     ///< landmark block of five
  std::vector<bool> is_seen_;      ///< landmark with a second view
  PoseManifold manifold_;
  ceres::CauchyLoss loss_;
  ceres::Problem problem_;
};

/// 1σ of an observation's point and affinity in normalised units.
[[nodiscard]] double point_sigma(const WindowObservation& seen, const SlidingWindow& window,
                                 const WindowRefineOptions& options);
[[nodiscard]] double affine_sigma(const WindowObservation& seen,
                                  const WindowRefineOptions& options);

/// False for an observation of a point behind the view: it cannot be evaluated at the start.
[[nodiscard]] bool is_in_front(const SlidingWindow& window, const WindowObservation& seen);

/// The prior between a view and the next one, for the poses that they have.
[[nodiscard]] PlanarPrior planar_prior(const SlidingWindow& window, std::size_t view,
                                       const WindowRefineOptions& options);

}  // namespace oneac
