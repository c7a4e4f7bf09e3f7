#pragma once

#include "oneac/solvers/planar_pose.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

namespace oneac {

/// Planar motion followed by a pitch of the second camera: R_x(pitch) X2 = R_yaw X1 + t_planar.
struct PitchedPose {
  PlanarPose planar;   ///< |t| = 1
  double pitch = 0.0;  ///< [rad], rotates rays of the second view into the level frame

  [[nodiscard]] RelativePose pose() const {
    const Eigen::Matrix3d Q = pitch_rotation(pitch);
    const RelativePose level = planar.pose();
    return {Q.transpose() * level.R, Q.transpose() * level.t};
  }
};

/// Largest pitch that relpose_1ac_planar_pitch looks for unless told otherwise [rad]: any.
constexpr double kAnyPitch = 1.5707963267948966;

/// Planar motion with an unknown pitch between the views, from one affine
/// correspondence on any surface.
///
/// Model: the four entries e(θ) of the planar E solve a 3×4 system for every pitch θ, and obey
/// E21² + E23² = E12² + E32² for the right one: a sextic in tan θ.
/// docs/solvers/relpose_1ac_planar_pitch.md Not in the paper; three unknowns, three equations.
/// @param ac         x1, x2: normalised image points [-]; A: ∂x2/∂x1 [-]; Y along
///                   gravity in the first view
/// @param max_pitch  only roots with |θ| up to it [rad]; a car's suspension stays
///                   within a few degrees
/// @return           up to six poses T_2_1, |t| = 1, each with the point before both cameras. The
///                   true one is often not the one of least pitch: let the consensus choose
/// @degenerate       rank deficient systems, no motion, det A ≤ 0, not finite: empty
/// @cost             about 3 µs, no allocation; pure, thread-safe
[[nodiscard]] SolutionSet<PitchedPose, 6> relpose_1ac_planar_pitch(const AffineCorrespondence& ac,
                                                                   double max_pitch = kAnyPitch);

/// Least squares over N ≥ 2 correspondences on any surfaces; `weights` (one each, ≥ 0) may be null.
/// Descends from the minimal solutions of up to sixteen of them; the least cost wins.
[[nodiscard]] SolutionSet<PitchedPose, 1> relpose_nac_planar_pitch(AcSpan acs,
                                                                   const double* weights = nullptr,
                                                                   double max_pitch = kAnyPitch);

}  // namespace oneac
