#pragma once

#include "oneac/refine/sliding_window.h"

namespace oneac {

/// Levenberg–Marquardt over the points of a window, see WindowEquations: damping, acceptance of
/// steps and the ends of the search as Ceres has them. Leaves the window alone unless usable.
/// Source of the damping: Nielsen, Damping Parameter in Marquardt's Method, 1999.
[[nodiscard]] WindowRefineResult adjust_points(SlidingWindow& window,
                                               const WindowRefineOptions& options,
                                               double function_tolerance);

}  // namespace oneac
