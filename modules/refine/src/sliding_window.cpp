#include "oneac/refine/sliding_window.h"

#include "window_adjustment.h"
#include "window_problem.h"

#include "oneac/base/check_bounds.h"
#include "oneac/base/require.h"
#include "oneac/base/workers.h"

#include <ceres/solver.h>

#include <cmath>
#include <memory>
#include <string>

namespace oneac {
namespace {

// Relative change of the cost that ends the search: of a cost near 500 it is 0.05, a third of a
// standard deviation of one unknown, and the next keyframe goes on from there.
constexpr double kFunctionTolerance = 1e-4;
// [σ] Under the Cauchy loss the landmarks of wrong tracks creep on for long and lower the cost, but
// poses that move by less have found their place: later steps shrink to about four fifths, so that
// less than half a σ is left, and the next keyframe goes on from there.
constexpr double kSmallStep = 0.1;

void require_consistent(const SlidingWindow& window) {
  require(window.focal_px > 0.0, "window.focal_px", window.focal_px, "positive");
  for (const WindowLandmark& landmark : window.landmarks) {
    require(landmark.anchor < window.views.size(), "window.anchor",
            static_cast<double>(landmark.anchor), "the index of a view");
  }
  for (const WindowObservation& seen : window.observations) {
    require(seen.view < window.views.size(), "window.view", static_cast<double>(seen.view),
            "the index of a view");
    require(seen.landmark < window.landmarks.size(), "window.landmark",
            static_cast<double>(seen.landmark), "the index of a landmark");
  }
}

WindowRefineResult adjust_with_ceres(SlidingWindow& window, const WindowRefineOptions& options) {
  WindowRefineResult result;
  WindowProblem problem(window, options);
  if (problem.empty()) return result;
  const ceres::Solver::Summary summary = problem.solve(options.max_iterations, kFunctionTolerance);
  result.initial_cost = summary.initial_cost;
  result.final_cost = summary.final_cost;
  result.iterations = summary.num_successful_steps + summary.num_unsuccessful_steps;
  result.usable = summary.IsSolutionUsable() && summary.final_cost <= summary.initial_cost &&
                  problem.is_finite();
  if (result.usable) problem.store(window);
  return result;
}

}  // namespace

void WindowRefineOptions::validate() const {
  check_bounds("window", *this);
}

struct WindowRefiner::Memory {
  explicit Memory(Workers* workers) : equations(workers != nullptr ? *workers : alone) {}

  Workers alone;
  WindowEquations equations;
};

WindowRefiner::WindowRefiner(Workers* workers) : memory_(std::make_unique<Memory>(workers)) {}
WindowRefiner::~WindowRefiner() = default;
WindowRefiner::WindowRefiner(WindowRefiner&&) noexcept = default;
WindowRefiner& WindowRefiner::operator=(WindowRefiner&&) noexcept = default;

WindowRefineResult WindowRefiner::refine(SlidingWindow& window,
                                         const WindowRefineOptions& options) {
  options.validate();
  require_consistent(window);
  // Points move without the affinities: those are looked at once, at the end.
  if (options.affine_terms()) static_cast<void>(fit_patches(window, options));
  WindowRefineResult result =
      options.solver == "fast"
          ? adjust_points(window, options, {kFunctionTolerance, kSmallStep}, memory_->equations)
          : adjust_with_ceres(window, options);
  result.affine_consistent = fit_patches(window, options);
  return result;
}

WindowRefineResult refine_window(SlidingWindow& window, const WindowRefineOptions& options) {
  return WindowRefiner().refine(window, options);
}

}  // namespace oneac
