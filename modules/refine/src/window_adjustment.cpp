#include "window_adjustment.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oneac {
namespace {

constexpr double kFirstRadius = 1e4;  // inverse of the first damping
constexpr double kLargestRadius = 1e16;
constexpr double kSmallestRadius = 1e-32;
// A step must bring this share of what the model promised.
constexpr double kWorthwhile = 1e-3;

WindowState state_of(const SlidingWindow& window) {
  WindowState state;
  for (const WindowView& view : window.views) state.poses.push_back(view.T_view_map);
  for (const WindowLandmark& landmark : window.landmarks) {
    state.points.emplace_back(landmark.x.x(), landmark.x.y(), landmark.inverse_depth);
  }
  return state;
}

void store(const WindowState& state, SlidingWindow& window) {
  for (std::size_t i = 0; i < window.views.size(); ++i) {
    if (!window.views[i].fixed) window.views[i].T_view_map = state.poses[i];
  }
  for (std::size_t i = 0; i < window.landmarks.size(); ++i) {
    window.landmarks[i].x = state.points[i].head<2>();
    window.landmarks[i].inverse_depth = state.points[i].z();
  }
}

/// The radius of trust: 1 / damping.
struct Trust {
  double radius = kFirstRadius;
  double shrink = 2.0;

  void accept(double gain) {
    const double x = 2.0 * gain - 1.0;
    radius = std::min(radius / std::max(1.0 / 3.0, 1.0 - x * x * x), kLargestRadius);
    shrink = 2.0;
  }
  void reject() {
    radius /= shrink;
    shrink *= 2.0;
  }
};

}  // namespace

WindowRefineResult adjust_points(SlidingWindow& window, const WindowRefineOptions& options,
                                 const AdjustmentEnds& ends, WindowEquations& equations) {
  WindowRefineResult result;
  equations.set(window, options);
  if (equations.empty()) return result;
  WindowState state = state_of(window);
  const auto start = equations.cost(state);
  if (!start) return result;
  double cost = *start;
  result.initial_cost = cost;
  equations.linearise(state);
  Trust trust;
  while (result.iterations < options.max_iterations && trust.radius > kSmallestRadius) {
    ++result.iterations;
    const auto step = equations.solve(1.0 / trust.radius);
    if (step && !(step->decrease > 0.0)) break;  // a minimum, to the last digit
    WindowState candidate = step ? equations.moved(state, *step) : WindowState{};
    const auto next = step ? equations.cost(candidate) : std::nullopt;
    const double gain = next ? (cost - *next) / step->decrease : 0.0;
    const bool rests = next && step->chi2 <= ends.pose_sigmas * ends.pose_sigmas *
                                                 static_cast<double>(step->poses.size());
    const bool converged = next && std::abs(cost - *next) <= ends.cost_share * cost;
    if (gain > kWorthwhile) {
      state = std::move(candidate);
      cost = *next;
      trust.accept(gain);
    } else {
      trust.reject();
    }
    if (converged || rests) break;
    if (gain > kWorthwhile) equations.linearise(state);
  }
  result.final_cost = cost;
  result.usable = true;
  store(state, window);
  return result;
}

}  // namespace oneac
