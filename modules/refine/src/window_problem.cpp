#include "window_problem.h"

#include "patch_transfer.h"

#include "oneac/geometry/angles.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace oneac {
namespace {

// [map lengths] two views closer than this did not travel: no elevation to speak of.
constexpr double kShortestTravel = 1e-6;

ceres::Problem::Options borrowing() {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

}  // namespace

bool is_in_front(const SlidingWindow& window, const WindowObservation& seen) {
  const WindowLandmark& landmark = window.landmarks[seen.landmark];
  const RelativePose& anchor = window.views[landmark.anchor].T_view_map;
  return PatchTransfer(anchor, window.views[seen.view].T_view_map, landmark).in_front();
}

PlanarPrior planar_prior(const SlidingWindow& window, std::size_t view,
                         const WindowRefineOptions& options) {
  const RelativePose T =
      window.views[view + 1].T_view_map * window.views[view].T_view_map.inverse();
  PlanarPrior prior{};
  for (int axis = 0; axis < 3; ++axis) {
    prior.right[axis] = window.R_level_cam(0, axis);
    prior.down[axis] = window.R_level_cam(1, axis);
    prior.ahead[axis] = window.R_level_cam(2, axis);
  }
  prior.sigma_travel =
      std::max(T.t.norm() * options.travel_elevation_deg * kDegree, kShortestTravel);
  prior.sigma_rotation = options.suspension_deg * kDegree;
  return prior;
}

double point_sigma(const WindowObservation& seen, const SlidingWindow& window,
                   const WindowRefineOptions& options) {
  return seen.point_sigma > 0.0 ? seen.point_sigma : options.point_noise_px / window.focal_px;
}

double affine_sigma(const WindowObservation& seen, const WindowRefineOptions& options) {
  return seen.affine_sigma > 0.0 ? seen.affine_sigma : options.affine_noise;
}

WindowProblem::WindowProblem(const SlidingWindow& window, const WindowRefineOptions& options)
    : poses_(7 * window.views.size()),
      landmarks_(5 * window.landmarks.size()),
      is_patch_(window.landmarks.size(), false),
      is_seen_(window.landmarks.size(), false),
      loss_(options.loss_sigmas),
      problem_(borrowing()) {
  add_views(window);
  for (std::size_t i = 0; i < window.landmarks.size(); ++i) {
    const WindowLandmark& from = window.landmarks[i];
    double* to = landmark(i);
    to[0] = from.x.x();
    to[1] = from.x.y();
    to[2] = from.inverse_depth;
    to[3] = from.gradient.x();
    to[4] = from.gradient.y();
  }
  for (const WindowObservation& seen : window.observations) {
    if (seen.view == window.landmarks[seen.landmark].anchor) continue;
    if (!is_in_front(window, seen)) continue;
    is_seen_[seen.landmark] = true;
    if (options.affine_terms() && seen.affine_consistent) is_patch_[seen.landmark] = true;
  }
  for (const WindowObservation& seen : window.observations) add_observation(window, seen, options);
  add_planar_priors(window, options);
}

void WindowProblem::add_views(const SlidingWindow& window) {
  for (std::size_t i = 0; i < window.views.size(); ++i) {
    store_pose(window.views[i].T_view_map, pose(i));
    problem_.AddParameterBlock(pose(i), 7, &manifold_);
    if (window.views[i].fixed) problem_.SetParameterBlockConstant(pose(i));
  }
}

void WindowProblem::add_observation(const SlidingWindow& window, const WindowObservation& seen,
                                    const WindowRefineOptions& options) {
  if (!is_seen_[seen.landmark]) return;  // a ray without depth says nothing
  if (!is_in_front(window, seen)) return;
  const std::size_t anchor = window.landmarks[seen.landmark].anchor;
  const bool patch = is_patch_[seen.landmark];
  add_point(seen, anchor, point_sigma(seen, window, options), patch);
  if (!patch || !seen.affine_consistent || seen.view == anchor) return;
  problem_.AddResidualBlock(new AffinityCost(seen.A, affine_sigma(seen, options)), &loss_,
                            pose(anchor), pose(seen.view), landmark(seen.landmark));
}

void WindowProblem::add_point(const WindowObservation& seen, std::size_t anchor, double sigma,
                              bool patch) {
  double* const block = landmark(seen.landmark);
  if (seen.view == anchor) {
    ceres::CostFunction* cost = nullptr;
    if (patch) {
      cost = new AnchorCost<5>(seen.x, sigma);
    } else {
      cost = new AnchorCost<3>(seen.x, sigma);
    }
    problem_.AddResidualBlock(cost, &loss_, block);
    return;
  }
  ceres::CostFunction* cost = nullptr;
  if (patch) {
    cost = new ReprojectionCost<5>(seen.x, sigma);
  } else {
    cost = new ReprojectionCost<3>(seen.x, sigma);
  }
  problem_.AddResidualBlock(cost, &loss_, pose(anchor), pose(seen.view), block);
}

void WindowProblem::add_planar_priors(const SlidingWindow& window,
                                      const WindowRefineOptions& options) {
  for (std::size_t i = 0; i + 1 < window.views.size(); ++i) {
    if (window.views[i].fixed && window.views[i + 1].fixed) continue;
    problem_.AddResidualBlock(new PlanarMotionCost(planar_prior(window, i, options)), nullptr,
                              pose(i), pose(i + 1));
  }
}

bool WindowProblem::empty() const {
  return std::none_of(is_seen_.begin(), is_seen_.end(), [](bool seen) { return seen; });
}

ceres::Solver::Summary WindowProblem::solve(int max_iterations, double function_tolerance) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = max_iterations;
  options.function_tolerance = function_tolerance;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (std::size_t i = 0; i < is_seen_.size(); ++i) {
    if (is_seen_[i]) options.linear_solver_ordering->AddElementToGroup(landmark(i), 0);
  }
  for (std::size_t i = 0; 7 * i < poses_.size(); ++i) {
    options.linear_solver_ordering->AddElementToGroup(pose(i), 1);
  }
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem_, &summary);
  return summary;
}

bool WindowProblem::is_finite() const {
  const auto finite = [](double value) { return std::isfinite(value); };
  return std::all_of(poses_.begin(), poses_.end(), finite) &&
         std::all_of(landmarks_.begin(), landmarks_.end(), finite);
}

void WindowProblem::store(SlidingWindow& window) const {
  for (std::size_t i = 0; i < window.views.size(); ++i) {
    if (!window.views[i].fixed) window.views[i].T_view_map = load_pose(&poses_[7 * i]);
  }
  for (std::size_t i = 0; i < window.landmarks.size(); ++i) {
    const double* from = &landmarks_[5 * i];
    window.landmarks[i].x << from[0], from[1];
    window.landmarks[i].inverse_depth = from[2];
    if (is_patch_[i]) window.landmarks[i].gradient << from[3], from[4];
  }
}

}  // namespace oneac
