#pragma once

#include "window_equations.h"

#include "oneac/refine/sliding_window.h"

namespace oneac {

/// When the search ends.
struct AdjustmentEnds {
  double cost_share = 0.0;   ///< [-] relative change of the cost
  double pose_sigmas = 0.0;  ///< [σ] step, root mean square over the unknowns of the poses
};

/// Levenberg–Marquardt over the points of a window, see WindowEquations: damping, acceptance of
/// steps and the ends of the search as Ceres has them. Leaves the window alone unless usable.
/// @param equations  whose memory is used
/// Source of the damping: Nielsen, Damping Parameter in Marquardt's Method, 1999.
[[nodiscard]] WindowRefineResult adjust_points(SlidingWindow& window,
                                               const WindowRefineOptions& options,
                                               const AdjustmentEnds& ends,
                                               WindowEquations& equations);

}  // namespace oneac
