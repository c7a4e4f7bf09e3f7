#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/solvers/span.h"

#include <functional>
#include <vector>

namespace oneac {

/// Relative pitches 0, +step, −step, +2 step, … within ±range [rad]; just 0 when either is 0.
[[nodiscard]] std::vector<double> pitch_sweep(double range, double step);

/// Which solvers make hypotheses.
struct HypothesisSolvers {
  bool ground = true;
  bool planar = true;
};

/// Solves every correspondence at one relative pitch θ between the views.
///
/// The camera's tilt is removed from both views and θ from the second, X2' = Rx(θ) L X2; the planar
/// motion (Ry, t) found there is Rx(−θ) Ry, Rx(−θ) t between the levelled cameras and is returned
/// for the tilted ones.
/// @param sink  called with each hypothesis, |t| as the solver gives it
void planar_hypotheses(AcSpan acs, const Eigen::Matrix3d& R_level_cam, double pitch,
                       const HypothesisSolvers& solvers,
                       const std::function<void(const RelativePose&)>& sink);

}  // namespace oneac
