#pragma once

#include "oneac/base/bound.h"
#include "oneac/robust/robust_result.h"
#include "oneac/robust/solver_pool.h"
#include "oneac/solvers/span.h"

#include <cstddef>
#include <string>
#include <vector>

namespace oneac {

/// Exhaustive one-AC consensus. validate() throws std::invalid_argument naming field, value, bound.
struct ConsensusOptions {
  SolverPool pool;            ///< whose hypotheses; a key per solver, such as "ground"
  double threshold_px = 1.0;  ///< [px] Sampson inlier bound; DoG points repeat to 0.3…0.5 px (1σ)
  int first_modes = 8;        ///< polished in a first look without pitch sweep; 0: none. Its answer
                              ///< stands when it explains the points
  int first_problems = 64;    ///< solved per solver in the first look
  double settled_cost = 0.25;  ///< [-] MSAC cost a point below which an answer stands: that of
                               ///< noise when the bound is two sigma; 1/3 says nothing. Less for
                               ///< bounds wider than a pixel at f = 700, by their square
  double pitch_sweep_deg =
      2.4;  ///< [deg] relative pitch covered each way; the suspension gives up to this
  double pitch_step_deg = 0.6;  ///< [deg] at f = 700 px 7 px, half of it to the nearest step:
                                ///< within the basin of the first polishing pass
  double roll_sweep_deg = 0.0;  ///< [deg] relative roll covered each way
  double roll_step_deg = 1.0;   ///< [deg]
  int minimal_problems = 1500;  ///< per solver, over all relative pitches; more correspondences are
                                ///< dealt to the pitches in turn
  int modes = 40;               ///< distinct hypotheses that are polished; reason in docs/decisions
  double mode_rotation_deg = 0.2;   ///< [deg] modes closer than both are one
  double mode_direction_deg = 8.0;  ///< [deg] polishing comes back from farther
  int finalists = 5;                ///< modes that are polished to the end
  int min_inliers = 15;             ///< fewer support nothing: five unknowns, three times over
  double standing_px =
      0.35;  ///< [px] median shift beside a rotation that is noise: the camera stands

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

template <class Visitor>
void describe(Visitor&& visit, ConsensusOptions& o) {
  for (std::size_t i = 0; i < SolverPool::size(); ++i) {
    visit(SolverPool::key(i), o.pool.on[i], "bool", SolverPool::meaning(i).c_str());
  }
  visit("threshold_px", o.threshold_px, "px", "Sampson inlier bound", Bound::positive());
  visit("first_modes", o.first_modes, "count", "polished in a first look without sweep; 0: none",
        Bound::at_least(0));
  visit("first_problems", o.first_problems, "count", "solved per solver in the first look",
        Bound::at_least(1));
  visit("settled_cost", o.settled_cost, "-", "cost a point below which the first look stands",
        Bound::from_to(0, 1));
  visit("pitch_sweep_deg", o.pitch_sweep_deg, "deg", "relative pitch covered each way",
        Bound::from_to(0, 10));
  visit("pitch_step_deg", o.pitch_step_deg, "deg", "step of the sweep", Bound::positive());
  visit("roll_sweep_deg", o.roll_sweep_deg, "deg", "relative roll covered each way",
        Bound::from_to(0, 10));
  visit("roll_step_deg", o.roll_step_deg, "deg", "step of that sweep", Bound::positive());
  visit("minimal_problems", o.minimal_problems, "count", "solved per solver and pair, about",
        Bound::at_least(1));
  visit("modes", o.modes, "count", "distinct hypotheses that are polished", Bound::at_least(1));
  visit("mode_rotation_deg", o.mode_rotation_deg, "deg", "hypotheses closer than this ...",
        Bound::at_least(0));
  visit("mode_direction_deg", o.mode_direction_deg, "deg", "... and this are one mode",
        Bound::at_least(0));
  visit("finalists", o.finalists, "count", "modes that are polished to the end",
        Bound::at_least(1));
  visit("min_inliers", o.min_inliers, "count", "a pose with fewer is refused", Bound::at_least(5));
  visit("standing_px", o.standing_px, "px", "median shift, rotation removed, of a standing camera",
        Bound::at_least(0));
}

/// Relative pose from one-AC hypotheses without a random number: correspondences are solved
/// (several at a time, solvers/batch.h), every hypothesis is scored on a sample of the points (MSAC
/// on the Sampson distance), the best few distinct ones are polished with five degrees of freedom,
/// and the best after polishing wins. A first look takes the motion as planar; where its answer
/// does not explain the points, every correspondence is solved at every relative pitch and roll of
/// the sweep and many modes are polished. Of two poses that one plane admits the one nearer to
/// planar motion is taken.
///
/// @param acs          normalised correspondences of the (tilted) camera
/// @param R_level_cam  removes the camera's tilt (geometry/levelling.h), the same in both views
/// @param focal_px     what turns threshold_px into normalised units [px]
/// @param prior        what inertia and sensors say of the motion, part of the choice between rest
///                     and travel (motion_evidence.h)
[[nodiscard]] RobustResult one_ac_consensus(AcSpan acs, const Eigen::Matrix3d& R_level_cam,
                                            double focal_px, const ConsensusOptions& options,
                                            const MotionPrior& prior = {});

}  // namespace oneac
