#pragma once

#include "oneac/frontend/frame_result.h"

#include <Eigen/Core>

namespace oneac {

/// StepResult::covariance out of what the step's other fields and its two views say.
/// @param of_direction  TwoView::covariance: of (w, v) with v ⊥ t, |t| = 1; zero where nobody told:
///                      then what a vehicle's inertia allows stands for it
/// @param rest_sigma  [m] 1σ of a rest, where something measured it
[[nodiscard]] Eigen::Matrix<double, 6, 6> step_covariance(
    const StepResult& step, const Eigen::Matrix<double, 6, 6>& of_direction,
    double rest_sigma = 0.0);

}  // namespace oneac
